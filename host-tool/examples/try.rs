use host_tool::diagnosis::*;
use host_tool::files::*;
use host_tool::identification::Campaign;
use std::time::Instant;
fn main() {
    for dir in std::env::args().skip(1) {
        let t0 = Instant::now();
        let ds = Dataset::read(&dir).unwrap();
        let rf = RobotFile::read(format!("{dir}/model.toml")).unwrap();
        let c = Campaign::read(&ds, rf).unwrap();
        let subject = subject::Subject::of(&c).unwrap();
        let stretches: Vec<_> = c.traces.iter().enumerate().flat_map(|(k, t)| stretch::Stretch::of(t, k, &subject)).collect();
        let (ev, lin) = preparation::prepared(&subject, stretches).unwrap();
        let t1 = t0.elapsed();
        let s = selection::select(&ev, &subject, lin, &|_| ());
        let last = s.steps.last().unwrap();
        let null = &s.steps[0].rest;
        let r = |x: &rest::Rest| x.ratios.iter().map(|r| r.iter().map(|v| format!("{v:.2}")).collect::<Vec<_>>().join(" ")).collect::<Vec<_>>().join(" | ");
        println!("{} {:.1?}/{:.1?} null worst {:.1} excess {:.0} misses {:.0} -> worst {:.2} explained {:.4} misses {:.0}", dir.rsplit('/').next().unwrap(), t1, t0.elapsed(), null.worst(), null.excess, null.misses, last.rest.worst(), 1.0 - last.rest.excess / null.excess.max(1.0), last.rest.misses);
        println!("     null {}", r(null));
        println!("     last {}", r(&last.rest));
        for e in &last.linear.point.effects { println!("   = {} j{} {:.4?}", e.definition.name, e.joint, e.values); }
        for x in s.rivals.iter().take(6) { println!("     rival round {} {} j{} {:.4?} worst {:.1} excess {:.0} misses {:.0}", x.round, x.candidate.effect.definition.name, x.candidate.effect.joint, x.candidate.effect.values, x.rest.worst(), x.rest.excess, x.rest.misses); }
    }
}
