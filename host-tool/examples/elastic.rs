use host_tool::diagnosis::*;
use host_tool::effects::{Definition, Search};
use host_tool::files::*;
use host_tool::identification::Campaign;
use linearisation::Which;
use voltage::Added;
fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let dir = &args[0];
    let name = &args[1];
    let joint: u8 = args[2].parse().unwrap();
    let ds = Dataset::read(dir).unwrap();
    let rf = RobotFile::read(format!("{dir}/model.toml")).unwrap();
    let c = Campaign::read(&ds, rf).unwrap();
    let subject = subject::Subject::of(&c).unwrap();
    let stretches: Vec<_> = c.traces.iter().enumerate().flat_map(|(k, t)| stretch::Stretch::of(t, k, &subject)).collect();
    let (ev, lin) = preparation::prepared(&subject, stretches).unwrap();
    let given = fit::fit(&ev, &subject, preparation::as_given(&subject), 0).unwrap();
    let d = Definition::by_name(name).unwrap();
    let Search::From(starts) = d.search else { panic!() };
    for l in [&lin, &given] {
        println!("objective {:.0} score {:.0}", l.objective, l.score().train);
        for values in starts(&search::typical(l, &ev, &subject, joint)) {
            let e = Added { definition: d, joint, values: values.clone() };
            let p = search::promise(l, &ev, &e);
            let c0 = candidate::Candidate::of(l, &ev, e.clone(), Which::TRAIN).0;
            let c1 = c0.clone().refined(l, &ev, 6, Which::TRAIN);
            println!("  {values:.4?} promise {p:.0} start {:.0} -> {:.0} {:.4?}", c0.score.train, c1.score.train, c1.effect.values);
        }
    }
}
