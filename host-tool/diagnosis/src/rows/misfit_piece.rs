//! What a model leaves of one joint in one train stretch: its size by class of speed, and for how many rows it
//! lasts.

use super::evidence::Evidence;
use super::speed_classes::classes;
use crate::criteria::RowCriteria;

/// What is left of one joint in one stretch.
#[derive(Clone, Debug, Default)]
pub struct Piece {
    /// Class of speed of every row.
    pub class: Vec<u8>,
    /// Mean square by class [V^2].
    pub square_v2: Vec<f64>,
    /// Rows with weight, by class.
    count: Vec<f64>,
    /// How many neighbouring rows say the same, at least 1.
    pub correlation: f64,
    /// How many rows that do not say the same count as one all the same, at least 1.
    pub repeated: f64,
}

impl Piece {
    /// That of residuals of the stretch `s` [V]; `edges` part its classes of speed.
    pub fn of(
        evidence: &Evidence,
        joint: usize,
        s: usize,
        residual_v: &[f64],
        edges: &[f64],
    ) -> Self {
        let criteria = &evidence.criteria.rows;
        let floor_v2 = evidence.floor_v(joint, s).powi(2);
        let class = classes(evidence, joint, s, edges);
        let mut piece = Self { class, correlation: 1.0, repeated: 1.0, ..Self::default() };
        let (sums, count) = piece.sums(residual_v, edges.len() + 1);
        let whole: f64 = sums.iter().sum::<f64>() / count.iter().sum::<f64>().max(1.0);
        let pooled = criteria.pooled_rows;
        let square =
            |(sum, count): (&f64, &f64)| ((sum + pooled * whole) / (count + pooled)).max(floor_v2);
        piece.square_v2 = sums.iter().zip(&count).map(square).collect();
        piece.count = count;
        piece.correlation = correlation(&piece.whitened(residual_v), criteria);
        if evidence.systematic {
            let part = evidence.part_of_log(joint, s);
            piece.repeated = piece.alike(floor_v2, part * criteria.most_systematic_rows);
        }
        piece
    }

    /// How many rows count as one.
    pub fn rows_as_one(&self) -> f64 {
        self.correlation * self.repeated
    }

    /// The same size with all rows independent.
    pub fn make_independent(&mut self) {
        (self.correlation, self.repeated) = (1.0, 1.0);
    }

    /// The same size with rows as independent as in another, where that are more.
    pub fn make_as_independent(&mut self, other: &Self) {
        if other.rows_as_one() < self.rows_as_one() {
            (self.correlation, self.repeated) = (other.correlation, other.repeated);
        }
    }

    /// How many of the independent rows count as one where all but noise of so many squares [V^2] is
    /// systematic, of which there are no more than `most` rows.
    fn alike(&self, floor_v2: f64, most: f64) -> f64 {
        let rows: f64 = self.count.iter().sum::<f64>().max(1.0);
        let (squares, _) = self.squares();
        let noise = (floor_v2 * rows / squares.max(f64::MIN_POSITIVE)).min(1.0);
        let most_alike = (rows / self.correlation / most).max(1.0);
        noise + (1.0 - noise) * most_alike
    }

    /// Squares and rows with weight, by class. Rows that are exactly zero have none.
    fn sums(&self, residual_v: &[f64], classes: usize) -> (Vec<f64>, Vec<f64>) {
        let (mut sums, mut count) = (vec![0.0; classes], vec![0.0; classes]);
        for (&class, &row) in self.class.iter().zip(residual_v).filter(|(_, row)| **row != 0.0) {
            sums[usize::from(class)] += row * row;
            count[usize::from(class)] += 1.0;
        }
        (sums, count)
    }

    /// Squares of what is left [V^2], and of how many rows.
    fn squares(&self) -> (f64, f64) {
        let squares = self.square_v2.iter().zip(&self.count).map(|(v2, n)| v2 * n).sum();
        (squares, self.count.iter().sum())
    }

    fn whitened(&self, residual_v: &[f64]) -> Vec<f64> {
        let unit = |class: &u8| self.square_v2[usize::from(*class)].sqrt();
        residual_v.iter().zip(&self.class).map(|(row, class)| row / unit(class)).collect()
    }

    /// Log-likelihood of residuals [V] whose size is free in each class, of a motor that gets `gain` of its
    /// command.
    pub fn log_likelihood(&self, noise: NoiseOfRows, residual_v: &[f64], gain: f64) -> f64 {
        let (sums, count) = self.sums(residual_v, self.square_v2.len());
        let of_class = |(sum, count): (&f64, &f64)| {
            let square_v2 = noise.as_sent(sum / count.max(1.0), gain);
            -0.5 * count / self.rows_as_one() * square_v2.ln()
        };
        sums.iter().zip(&count).map(of_class).sum()
    }
}

/// Gives all rows of some pieces the size that they have together. Without rows that have weight they keep theirs.
pub fn pool(pieces: &mut [Piece]) {
    let all: Vec<(f64, f64)> = pieces.iter().map(Piece::squares).collect();
    let squares: f64 = all.iter().map(|(squares, _)| squares).sum();
    let rows: f64 = all.iter().map(|(_, rows)| rows).sum();
    if rows > 0.0 {
        pieces.iter_mut().for_each(|piece| piece.square_v2.fill(squares / rows));
    }
}

/// Noise of rows.
#[derive(Clone, Copy, Debug)]
pub struct NoiseOfRows {
    /// Its mean square [V^2].
    pub square_v2: f64,
    /// Squares up to so many times that are the method's own, and grow as noise does.
    pub own_part: f64,
}

impl NoiseOfRows {
    /// A mean square of rows [V^2] of which `gain` of every command reaches the motor, in volts of the command
    /// as it was sent, and at least noise. Whatever takes a part of the command takes that part of what is
    /// left, too; what adds to it adds to the noise, and explains nothing of the rest by that.
    fn as_sent(self, square_v2: f64, gain: f64) -> f64 {
        let unit = gain.powi(2).max(1e-12);
        let added_v2 = self.own_part * self.square_v2 * (unit - 1.0).max(0.0);
        (square_v2 / unit).max(square_v2 - added_v2).max(self.square_v2)
    }
}

/// How many neighbouring rows count as one: 1 + 2 times the sum of the autocorrelation up to where
/// it first vanishes.
fn correlation(rows: &[f64], criteria: &RowCriteria) -> f64 {
    let product = |lag: usize| -> f64 { rows.iter().zip(&rows[lag..]).map(|(a, b)| a * b).sum() };
    let most = (rows.len() / criteria.fewest_independent_rows.max(1)).max(1);
    let square = product(0).max(f64::MIN_POSITIVE);
    let positive = (1..most).map(|lag| product(lag) / square).take_while(|part| *part > 0.0);
    1.0 + 2.0 * positive.sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motor_that_gets_more_or_less_of_the_command_neither_gains_nor_loses_by_its_noise() {
        for gain in [0.5, 0.93, 1.0, 1.07, 2.0] {
            let noise = NoiseOfRows { square_v2: 4e-6, own_part: 2.25 };
            let sent = |times: f64| noise.as_sent(times * noise.square_v2, gain) / noise.square_v2;
            assert!((sent(gain * gain) - 1.0).abs() < 1e-9, "{gain}");
            assert!(sent(100.0) > 90.0, "{gain}");
            assert!(sent(0.1) >= 1.0, "{gain}");
        }
    }

    #[test]
    fn noise_counts_by_its_rows_and_what_is_systematic_by_its_swings() {
        let piece = |square_v2: f64, correlation: f64| Piece {
            square_v2: vec![square_v2],
            count: vec![2000.0],
            correlation,
            ..Piece::default()
        };
        let floor_v2 = 1e-4;
        assert_eq!(piece(floor_v2, 2.0).alike(floor_v2, 200.0), 1.0);
        // A thousand rows, three quarters of whose squares are systematic, of which there are 200.
        assert!((piece(4.0 * floor_v2, 2.0).alike(floor_v2, 200.0) - 4.0).abs() < 1e-9);
        // Rows that last longer than that are few already.
        assert_eq!(piece(4.0 * floor_v2, 100.0).alike(floor_v2, 200.0), 1.0);
    }

    #[test]
    fn rows_that_are_pooled_have_one_size_and_as_many_squares() {
        let piece = |square_v2: [f64; 2], count: [f64; 2]| Piece {
            square_v2: square_v2.to_vec(),
            count: count.to_vec(),
            ..Piece::default()
        };
        let mut pieces = [piece([100.0, 50.0], [10.0, 20.0]), piece([1.0, 2.0], [30.0, 40.0])];
        pool(&mut pieces);
        assert!(pieces.iter().flat_map(|piece| &piece.square_v2).all(|v2| *v2 == 21.1));
        let squares: f64 = pieces.iter().map(|piece| piece.squares().0).sum();
        assert!((squares - 2110.0).abs() < 1e-9, "{squares}");
        let mut at_rest = [piece([4e-6, 4e-6], [0.0, 0.0])];
        pool(&mut at_rest);
        assert_eq!(at_rest[0].square_v2, [4e-6, 4e-6]);
    }
}
