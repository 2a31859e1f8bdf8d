use host_tool::diagnosis::*;
use host_tool::effects::Definition;
use host_tool::files::*;
use host_tool::identification::Campaign;
use voltage::Added;
fn main() {
    for dir in std::env::args().skip(1) {
        let ds = Dataset::read(&dir).unwrap();
        let rf = RobotFile::read(format!("{dir}/model.toml")).unwrap();
        let c = Campaign::read(&ds, rf).unwrap();
        let subject = subject::Subject::of(&c).unwrap();
        let stretches: Vec<_> = c.traces.iter().enumerate().flat_map(|(k, t)| stretch::Stretch::of(t, k, &subject)).collect();
        let (ev, lin) = preparation::prepared(&subject, stretches).unwrap();
        let t: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(format!("{dir}/truth.json")).unwrap()).unwrap();
        let mut point = preparation::as_given(&subject);
        for c in t["causes"].as_array().unwrap() {
            let d = Definition::by_name(c["effect"].as_str().unwrap()).unwrap();
            let values: Vec<f64> = d.parameters.iter().map(|p| c["parameters"][p.name].as_f64().unwrap_or(0.0)).collect();
            point.effects.push(Added { definition: d, joint: c["joint"].as_u64().unwrap() as u8, values });
        }
        let all: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(format!("{dir}/../truth.json")).unwrap()).unwrap();
        let number: usize = dir[dir.len()-3..].parse().unwrap();
        let mut exact = point.clone();
        exact.robot = serde_json::from_value(all["cases"][number - 1]["robot"].clone()).unwrap();
        let r = |x: &rest::Rest| x.ratios.iter().map(|r| r.iter().map(|v| format!("{v:.2}")).collect::<Vec<_>>().join(" ")).collect::<Vec<_>>().join(" | ");
        println!("{dir} null {}", r(&rest::Rest::of(&ev, &lin)));
        let f = fit::fit(&ev, &subject, exact.clone(), 0).unwrap();
        println!("   exact: obj {:.0} {}", f.objective, r(&rest::Rest::of(&ev, &f)));
        let tr = voltage::Trial::of(&ev.stretches[2], &exact);
        let j = exact.effects[0].joint as usize - 1;
        let sf = tr.shortfall(j);
        for k in (3000..3200).step_by(1) { if k < 3100 { print!("{:.2} ", sf[k]); } }
        println!();
        for n in [0, 4] {
            let f = fit::fit(&ev, &subject, point.clone(), n).unwrap();
            println!("   {n}: obj {:.0} {}", f.objective, r(&rest::Rest::of(&ev, &f)));
            for e in &f.point.effects { println!("      {} {:.4?}", e.definition.name, e.values); }
        }
    }
}
