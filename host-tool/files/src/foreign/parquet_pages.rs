//! Pages of a Parquet file whose counts of values can be believed.
//!
//! The library makes room for as many values as a page claims before it looks for them.

use parquet::column::page::{Page, PageMetadata, PageReader};
use parquet::errors::{ParquetError, Result};

/// Values that a page may have however few its bytes: constant columns take next to none.
const FREE_VALUES: usize = 1 << 22;
/// Values that a byte may stand for beyond that.
const VALUES_PER_BYTE: usize = 64;

/// Pages of another reader, each looked at before it is passed on.
pub(super) struct BoundedPages(pub(super) Box<dyn PageReader>);

impl PageReader for BoundedPages {
    fn get_next_page(&mut self) -> Result<Option<Page>> {
        self.0.get_next_page()?.map(checked).transpose()
    }

    fn peek_next_page(&mut self) -> Result<Option<PageMetadata>> {
        self.0.peek_next_page()
    }

    fn skip_next_page(&mut self) -> Result<()> {
        self.0.skip_next_page()
    }
}

impl Iterator for BoundedPages {
    type Item = Result<Page>;

    fn next(&mut self) -> Option<Self::Item> {
        self.get_next_page().transpose()
    }
}

fn checked(page: Page) -> Result<Page> {
    let (count, bytes) = (page.num_values() as usize, page.buffer().len());
    let most = match page {
        // Numbers in a dictionary stand there byte by byte.
        Page::DictionaryPage { .. } => bytes,
        _ => FREE_VALUES.max(VALUES_PER_BYTE.saturating_mul(bytes)),
    };
    match count <= most {
        true => Ok(page),
        false => Err(ParquetError::General(format!("{count} values in a page of {bytes} bytes"))),
    }
}
