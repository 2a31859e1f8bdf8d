use files::{ArmFile, Dataset}; use recordings::*; use servo::*;
fn main() {
    let dir = std::env::args().nth(1).unwrap();
    let arm = ArmFile::read(format!("{dir}/model.toml")).unwrap();
    let t = std::time::Instant::now();
    let c = ArmCampaign::read(&Dataset::read(&dir).unwrap(), arm.clone()).unwrap();
    let o = Outcome::of(&c, &Settings::default(), &|w| println!("{:?} {w}", t.elapsed())).unwrap();
    println!("{:?}", t.elapsed());
    for w in &o.whole { println!("{:?} {:.3?} +- {:.3?} {:?} {:.2} named {} {:?}", w.fit.effect, w.fit.values, w.fit.deviations, w.gain, w.probability, w.is_named, w.taken); }
    for (j, s) in o.selected.iter().enumerate() {
        println!("J{} undecided {:?}", j+1, s.undecided.iter().map(|u| (u.effect, u.gain.part)).collect::<Vec<_>>());
        for u in &s.model.unknowns { print!("  {:?}={:.4}", u.field, u.field.of(&s.model.fitted.servo)); } println!();
        for t in s.tried.iter().take(5) { println!("     {:20} {:6.3} cert {:5.1} halves {:6.3?} {:.4?}", t.effect, t.gain.part, t.gain.certainty, t.gain.halves, t.values); }
    }
    for c in &o.causes { println!("cause {} J{} named {} p {:.2} {:?}", c.effect, c.joint+1, c.is_named, c.probability, c.taken); }
    for (p, cs) in &o.pooled { println!("pooled {:?}", p.gain); for c in cs { println!("  {} J{} named {} p {:.2} {:?}", c.effect, c.joint+1, c.is_named, c.probability, c.taken); } }
    for k in 0..3 {
        let mut line = String::new(); let (mut a, mut n) = (0.0, 0);
        for j in 0..o.models.len() { let (mut s, mut m) = (0.0, 0);
            for mo in &o.motions { let l = &o.prepared.logs[mo.log]; for r in 0..l.record.len() { if l.counts[j][r] { s += (mo.stages[k][j][r] - l.record.joints[j].position[r]).powi(2); m += 1; } } }
            line += &format!(" {:6.2}", 1e3*(s/m as f64).sqrt()); a += s; n += m; }
        println!("{line}  all {:.2}", 1e3*(a/n as f64).sqrt());
    }
}
