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
        println!("{dir} read {:?}", t0.elapsed());
        let t0 = Instant::now();
        let stretches: Vec<_> = c.traces.iter().enumerate().flat_map(|(k, t)| stretch::Stretch::of(t, k, &subject)).collect();
        println!("stretches {:?} brisk {:?}", t0.elapsed(), stretches.iter().map(|s| s.brisk).collect::<Vec<_>>());
        let n0 = noise::Noise { white: 3.2e-8, growing: 3.2e-8 / 20f64.powi(4) };
        let mut ev = evidence::Evidence::new(stretches, subject.joints.clone(), [n0; 3]);
        let mut point = voltage::Point { robot: subject.robot, lag_s: [0.0; 3], effects: vec![] };
        for round in 0..3 {
            let t0 = Instant::now();
            let lin = fit::fit(&ev, &subject, point.clone(), if round == 0 { 3 } else { 4 }).unwrap();
            println!("fit {:?} objective {:.0} lag {:?}", t0.elapsed(), lin.objective, lin.point.lag_s);
            for s in 0..ev.stretches.len() {
                let mut line = format!("  log {} ", ev.stretches[s].log);
                for j in &ev.joints {
                    let r = &lin.residual[*j][ev.ranges(*j)[s].clone()];
                    let rms = (r.iter().map(|x| x * x).sum::<f64>() / r.len() as f64).sqrt();
                    line += &format!(" {:.2} ({:.2} mV)", rms, 1e3 * rms * ev.floor_v(*j, s));
                }
                println!("{line}");
            }
            for e in &lin.expected { let d = (e.unknown.get(&lin.point) - e.mean) / e.deviation; if d.abs() > 2.0 { print!(" {:?} {d:.1};", e.unknown) } }
            println!();
            point = lin.point.clone();
            let t0 = Instant::now();
            let mut noise = ev.noise;
            for j in &ev.joints {
                let raw: Vec<Vec<f64>> = ev.stretches.iter().filter(|s| !s.brisk).map(|s| voltage::Trial::of(s, &point).shortfall(*j)).collect();
                let refs: Vec<&[f64]> = raw.iter().map(|r| &r[..]).collect();
                noise[*j] = noise::Noise::of(&refs, ev.stretches[0].period_s).unwrap();
                println!("  noise j{} {:.2} mV/sample corner {:.1} Hz", j + 1, 1e3 * (noise[*j].white * 500.0).sqrt(), noise[*j].corner_hz());
            }
            println!("  {:?}", t0.elapsed());
            if round == 2 {
                let t0 = Instant::now();
                let c = search::candidates(&lin, &ev, &subject);
                println!("search {:?}; objective {:.0} holdout {:.0}", t0.elapsed(), lin.objective, lin.score().holdout);
                for c in c.iter().take(9) { println!("   {} j{} {:.5?} train {:.0} hold {:.0}", c.effect.definition.name, c.effect.joint, c.effect.values, c.score.train, c.score.holdout); }
            }
            if round < 2 { ev = evidence::Evidence::new(ev.stretches, subject.joints.clone(), noise); }
        }
    }
}
