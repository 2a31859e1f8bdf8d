//! Pages that tell where they come from and can be looked at closely.

use std::path::Path;
use std::process::Command;

use assert_cmd::cargo::cargo_bin;

use crate::rrr::{assert_tells, said, with_model};

/// A page of a command, made at a fixed second.
fn page(directory: &Path, line: &str, name: &str) -> String {
    let mut command = Command::new(cargo_bin("rrr"));
    command.current_dir(directory).args(line.split(' ')).env("SOURCE_DATE_EPOCH", "1700000000");
    let run = command.output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    std::fs::read_to_string(directory.join(name)).unwrap()
}

fn with_logs() -> tempfile::TempDir {
    let directory = with_model();
    let line = ["simulate", "--model", "model.toml", "--dataset", "task", "--out", "logs"];
    said(directory.path(), &line);
    directory
}

const VALIDATE: &str = "validate logs --model model.toml --out out";
const DIAGNOSE: &str = "diagnose logs --model model.toml --out out";

#[test]
fn reports_name_model_data_set_date_version_and_command_line() {
    let directory = with_logs();
    for (line, name) in [(VALIDATE, "out/validation.html"), (DIAGNOSE, "out/report.html")] {
        let html = page(directory.path(), line, name);
        assert_tells(&html, &["<td>Model</td><td>model.toml (SHA-256 ", "<td>logs (SHA-256 "]);
        assert_tells(&html, &["2023-11-14 22:13 UTC", concat!("rrr ", env!("CARGO_PKG_VERSION"))]);
        assert_tells(&html, &[&format!("<td>rrr {line}</td>")]);
    }
}

#[test]
fn the_hash_of_a_data_set_is_that_of_its_content() {
    let directory = with_logs();
    let hash = || host_tool::provenance::dataset_hash(&directory.path().join("logs"));
    let before = hash();
    assert_eq!(before.len(), 64);
    assert_eq!(hash(), before);
    let log = directory.path().join("logs/task.csv.gz");
    let mut bytes = std::fs::read(&log).unwrap();
    *bytes.last_mut().unwrap() ^= 1;
    std::fs::write(log, bytes).unwrap();
    assert_ne!(hash(), before);
}

#[test]
fn reports_made_at_the_same_second_are_the_same() {
    let directory = with_logs();
    let of = || page(directory.path(), VALIDATE, "out/validation.html");
    assert!(of() == of());
}

/// The drawing of a chart with this title.
fn chart<'a>(html: &'a str, title: &str) -> &'a str {
    let at = html.find(&format!("{title}\n</text>")).unwrap_or_else(|| panic!("no {title}"));
    let begin = html[..at].rfind("<svg ").unwrap();
    &html[begin..at + html[at..].find("</svg>").unwrap()]
}

/// Lowest and highest x of a chart.
fn x_range(chart: &str) -> [f64; 2] {
    let frame = chart.split("data-frame=\"").nth(1).unwrap().split('"').next().unwrap();
    let numbers: Vec<f64> = frame.split(' ').map(|number| number.parse().unwrap()).collect();
    [numbers[4], numbers[5]]
}

#[test]
fn residuals_have_axes_of_their_own_and_charts_show_the_whole_log() {
    let directory = with_logs();
    let html = page(directory.path(), VALIDATE, "out/validation.html");
    let command = chart(&html, "Joint 1, task.csv.gz");
    let left = chart(&html, "Left of Joint 1, task.csv.gz");
    assert!(left.contains("left [mV]") && !command.contains("left"), "{left}");
    for chart in [command, left] {
        let [first_s, last_s] = x_range(chart);
        assert!(first_s < 1.0 && last_s > 19.0, "{first_s} to {last_s}");
    }
}

#[test]
fn recorded_and_reconstructed_are_told_apart_in_colour() {
    let directory = with_logs();
    let html = page(directory.path(), VALIDATE, "out/validation.html");
    let command = chart(&html, "Joint 1, task.csv.gz");
    let (_, lines) = command.split_once("class=\"series\"").unwrap();
    // A line of one pixel lies on two of a screen's, half on each: so it would take on the colour beneath.
    for (colour, width) in [("#E69F00", "stroke-width=\"5\""), ("#0072B2", "stroke-width=\"2\"")] {
        let line = lines.lines().find(|line| line.contains("<polyline") && line.contains(colour));
        let line = line.unwrap_or_else(|| panic!("no line in {colour}"));
        let head = &line[..200.min(line.len())];
        assert!(line.contains("opacity=\"1\"") && line.contains(width), "{head}");
    }
}

#[test]
fn charts_zoom_by_a_script_inside_the_page_alone() {
    let directory = with_logs();
    for (line, name) in [(VALIDATE, "out/validation.html"), (DIAGNOSE, "out/report.html")] {
        let html = page(directory.path(), line, name);
        assert_eq!(html.matches("<script>").count(), 1, "{name}");
        for outside in ["src=", "href=\"http", "@import", "url(http"] {
            assert!(!html.contains(outside), "{name}: {outside}");
        }
        assert_tells(&html, &["addEventListener(\"wheel\"", "svg data-frame=\""]);
    }
}

/// What a user does at the first chart, and how its lines are stretched after each.
const LOOK_CLOSER: &str = r#"<script>
const svg = document.querySelector("svg[data-frame]"), box = svg.getBoundingClientRect();
const at = { clientX: box.x + box.width / 2, clientY: box.y + box.height / 2, cancelable: true };
const seen = [];
for (const event of [
  new WheelEvent("wheel", { ...at, deltaY: -400 }),
  new WheelEvent("wheel", { ...at, deltaY: -400, shiftKey: true }),
  new PointerEvent("pointerdown", at),
  new PointerEvent("pointermove", { ...at, clientX: at.clientX + 10 }),
  new MouseEvent("dblclick", at),
]) {
  svg.dispatchEvent(event);
  const numbers = [...svg.querySelectorAll("text")].filter((text) => text.checkVisibility());
  seen.push(svg.querySelector(".series").getAttribute("transform").match(/-?[\d.]+/g).join(" "));
  seen.push(numbers.map((text) => text.textContent.trim()).join(" "));
}
document.body.dataset.seen = seen.join(";");
</script>"#;

/// A page as a browser has it once its scripts have run; `None`, and a word, where there is no browser.
fn in_browser(directory: &Path, html: &str) -> Option<String> {
    let page = directory.join("browsed.html");
    std::fs::write(&page, html).unwrap();
    let mut browser = Command::new("chromium");
    browser.args(["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--dump-dom"]);
    browser.args(["--disable-background-networking", "--disable-component-update"]);
    browser.arg(format!("--user-data-dir={}", directory.join("profile").display()));
    let run = browser.arg(format!("file://{}", page.display())).output();
    let run = run.ok().filter(|run| run.status.success());
    if run.is_none() {
        test_support::skip("chromium is absent, or does not start");
    }
    run.map(|run| String::from_utf8(run.stdout).unwrap())
}

#[test]
fn a_chart_is_looked_at_closer_in_a_browser() {
    let directory = with_logs();
    let html = page(directory.path(), VALIDATE, "out/validation.html");
    let Some(dom) = in_browser(directory.path(), &(html + LOOK_CLOSER)) else { return };
    let seen = dom.split("data-seen=\"").nth(1).expect("the script ran").split('"').next().unwrap();
    let seen: Vec<&str> = seen.split(';').collect();
    let numbers = |k: usize| -> Vec<f64> {
        seen[2 * k].split(' ').map(|number| number.parse().unwrap()).collect()
    };
    let [wheel, with_shift, pressed, dragged, whole] = [0, 1, 2, 3, 4].map(numbers);
    let twice = std::f64::consts::E * std::f64::consts::E;
    assert!((wheel[0] - std::f64::consts::E).abs() < 1e-6 && wheel[3] == 1.0, "{wheel:?}");
    assert!((with_shift[0] - twice).abs() < 1e-6 && with_shift[3] > 2.0, "{with_shift:?}");
    assert_eq!(pressed, with_shift);
    assert!(dragged[0] == pressed[0] && dragged[4] > pressed[4] + 5.0, "{dragged:?}");
    assert_eq!(whole, [1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    // The axes have numbers of their own at each look.
    assert!(seen[1] != seen[3] && seen[3] != seen[9], "{seen:?}");
}
