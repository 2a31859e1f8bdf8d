//! A self-contained HTML page.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

use super::Chart;
use super::provenance::Provenance;
use super::zoom::SCRIPT;
use files::replace::replace_file;
use files::{FileError, Problem};

/// A page in the making: sentences, tables and charts in the order they are added.
#[derive(Clone, Debug)]
pub struct Page {
    title: String,
    body: String,
}

const STYLE: &str = "body{font:15px/1.5 system-ui,sans-serif;color:#282c34;max-width:1120px;\
margin:2rem auto;padding:0 1rem}h1{font-size:1.6rem;margin-bottom:.2rem}h2{font-size:1.15rem;\
margin-top:2rem;border-bottom:1px solid #e2e5e9}table{border-collapse:collapse;margin:.6rem 0}\
td,th{padding:.2rem .8rem;text-align:right;border-bottom:1px solid #e2e5e9}\
td:first-child,th:first-child{text-align:left}.lead{font-size:1.15rem}\
.words td,.words th{text-align:left;vertical-align:top}\
.charts{display:flex;flex-wrap:wrap;gap:.6rem}svg{max-width:100%;height:auto}\
svg[data-frame]{touch-action:none;cursor:zoom-in}.series *{vector-effect:non-scaling-stroke}\
.provenance{margin-top:2.5rem;color:#6b7280;font-size:.85rem}";

impl Page {
    /// A page with a title and the one sentence that matters.
    pub fn new(title: &str, lead: &str) -> Self {
        let body = format!("<h1>{}</h1>\n<p class=\"lead\">{}</p>\n", escape(title), escape(lead));
        Self { title: title.into(), body }
    }

    /// A heading.
    pub fn heading(&mut self, text: &str) -> &mut Self {
        let _ = writeln!(self.body, "<h2>{}</h2>", escape(text));
        self
    }

    /// A paragraph.
    pub fn paragraph(&mut self, text: &str) -> &mut Self {
        let _ = writeln!(self.body, "<p>{}</p>", escape(text));
        self
    }

    /// A paragraph that leads to another page.
    pub fn link(&mut self, text: &str, address: &str) -> &mut Self {
        let address = escape(address).replace('"', "&quot;");
        let _ = writeln!(self.body, "<p><a href=\"{address}\">{}</a></p>", escape(text));
        self
    }

    /// Charts side by side where there is room.
    pub fn charts(&mut self, charts: &[Chart]) -> &mut Self {
        let drawn: Vec<String> = charts.iter().map(Chart::to_svg).collect();
        self.pictures(&drawn)
    }

    /// SVG elements side by side where there is room.
    pub fn pictures(&mut self, drawn: &[String]) -> &mut Self {
        let _ = writeln!(self.body, "<div class=\"charts\">{}</div>", drawn.join("\n"));
        self
    }

    /// A list of sentences.
    pub fn list(&mut self, sentences: &[String]) -> &mut Self {
        let items: String =
            sentences.iter().map(|text| format!("<li>{}</li>", escape(text))).collect();
        let _ = writeln!(self.body, "<ul>{items}</ul>");
        self
    }

    /// A table; numbers stand to the right.
    pub fn table(&mut self, header: &[&str], rows: &[Vec<String>]) -> &mut Self {
        self.table_of_class("", header, rows)
    }

    /// A table of words, which stand to the left.
    pub fn words(&mut self, header: &[&str], rows: &[Vec<String>]) -> &mut Self {
        self.table_of_class(" class=\"words\"", header, rows)
    }

    fn table_of_class(&mut self, class: &str, header: &[&str], rows: &[Vec<String>]) -> &mut Self {
        let cells = |tag: &str, cells: &mut dyn Iterator<Item = &str>| -> String {
            cells.map(|cell| format!("<{tag}>{}</{tag}>", escape(cell))).collect()
        };
        let _ = writeln!(
            self.body,
            "<table{class}><tr>{}</tr>",
            cells("th", &mut header.iter().copied())
        );
        for row in rows {
            let row = cells("td", &mut row.iter().map(String::as_str));
            let _ = writeln!(self.body, "<tr>{row}</tr>");
        }
        self.body.push_str("</table>\n");
        self
    }

    /// Where the page comes from, at its end.
    pub fn provenance(&mut self, provenance: &Provenance) -> &mut Self {
        let Provenance { model, dataset, date, version, command_line } = provenance;
        let rows = [
            ("Model", model),
            ("Data set", dataset),
            ("Date", date),
            ("Version", version),
            ("Command line", command_line),
        ];
        let row = |(name, text): (&str, &String)| {
            format!("<tr><td>{name}</td><td>{}</td></tr>", escape(text))
        };
        let rows: String = rows.into_iter().map(row).collect();
        let _ = writeln!(self.body, "<table class=\"words provenance\">{rows}</table>");
        self
    }

    /// Writes the page, whole or not at all.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        let html = self.to_html();
        replace_file(path, |file| file.write_all(html.as_bytes()).map_err(Problem::Unwritable))
    }

    /// The whole page.
    pub fn to_html(&self) -> String {
        format!(
            "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
             <title>{}</title><style>{STYLE}</style></head>\n<body>\n{}{}</body></html>\n",
            escape(&self.title),
            self.body,
            self.script()
        )
    }

    /// The script, where there is a chart that it can zoom.
    fn script(&self) -> String {
        match self.body.contains("<svg data-frame") {
            true => {
                let how = "Charts: wheel to look closer (with Shift both axes), drag to move, double click for all.";
                format!("<p class=\"provenance\">{how}</p><script>{SCRIPT}</script>\n")
            }
            false => String::new(),
        }
    }
}

pub(super) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cannot_break_the_page() {
        let html = Page::new("a<b", "c & d").to_html();
        assert!(html.contains("<h1>a&lt;b</h1>") && html.contains("c &amp; d"));
    }
}
