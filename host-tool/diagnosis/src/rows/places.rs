//! Which rows of a joint belong to which stretch, log and fold.

use super::evidence::Evidence;

impl Evidence {
    /// Rows of a joint in a stretch.
    pub fn row_count(&self, joint: usize, s: usize) -> usize {
        self.filters[joint][s].row_count(self.stretches[s].len())
    }

    /// Where a joint's rows of each stretch lie among all of its rows.
    pub fn ranges(&self, joint: usize) -> Vec<std::ops::Range<usize>> {
        let mut begin = 0;
        let range = |s: usize| {
            let end = begin + self.row_count(joint, s);
            std::mem::replace(&mut begin, end)..end
        };
        (0..self.stretches.len()).map(range).collect()
    }

    /// Which fold each of a joint's train rows belongs to: pieces of logs, taken in turn.
    pub fn folds(&self, joint: usize) -> Vec<usize> {
        let (folds, piece_s) = (self.criteria.selection.folds, self.criteria.selection.piece_s);
        let of_stretch = |s: usize| {
            let row_period_s = self.filters[joint][s].row_period_s();
            let fold = move |k: usize| (s + (k as f64 * row_period_s / piece_s) as usize) % folds;
            (0..self.row_count(joint, s)).map(fold)
        };
        (0..self.train).flat_map(of_stretch).collect()
    }

    /// The train log, counted from 0, of each of a joint's train rows.
    pub fn logs_of_rows(&self, joint: usize) -> Vec<usize> {
        let (mut log, mut before) = (0, None);
        let of_stretch = |s: usize| {
            let is_next = before.is_some_and(|before| before != self.stretches[s].log);
            log += usize::from(is_next);
            before = Some(self.stretches[s].log);
            std::iter::repeat_n(log, self.row_count(joint, s))
        };
        (0..self.train).flat_map(of_stretch).collect()
    }

    /// How many logs are train logs.
    pub fn train_logs(&self) -> usize {
        let mut logs: Vec<usize> = self.stretches[..self.train].iter().map(|s| s.log).collect();
        logs.dedup();
        logs.len()
    }

    /// Rows of a joint that belong to train logs; they come first.
    pub fn train_rows(&self, joint: usize) -> usize {
        (0..self.train).map(|s| self.row_count(joint, s)).sum()
    }

    /// Stretches of train logs; they come first.
    pub fn train_stretches(&self) -> usize {
        self.train
    }
}
