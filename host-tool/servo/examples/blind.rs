use servo::*; use servo::synthetic::*; use servo::whole_arm::Whole;
fn show(name: &str, o: &Outcome) {
    print!("{name}: ");
    for w in &o.whole { if w.is_named { print!("[{} {:.3?}+-{:.3?} share {:.2}] ", w.fit.effect.name(), w.fit.values, w.fit.deviations, w.taken.share); } }
    for c in &o.causes { print!("[{} J{} named {} p {:.2} share {:.2} shrink {:.2}] ", c.effect, c.joint+1, c.is_named, c.probability, c.taken.share, c.taken.shrinkage); }
    for (p, cs) in &o.pooled { print!("pooled {:?} {:?}", p.gain, cs.iter().map(|c| (c.joint+1, c.is_named)).collect::<Vec<_>>()); }
    println!();
    for (j, s) in o.selected.iter().enumerate() {
        print!("   J{} rms {:.2} mrad", j+1, 1e3*s.base.fitted.rms());
        for t in s.tried.iter().take(3) { print!("  {} {:.3} c{:.1}", t.effect, t.gain.part, t.gain.certainty); }
        println!();
    }
    for w in &o.whole { println!("   {:?} {:.3?} {:?} {:?}", w.fit.effect, w.fit.values, w.gain, w.taken); }
    if !o.prepared.contacts.is_empty() { println!("   contacts {:?}", o.prepared.contacts); }
}
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let seeds = args[2].parse::<u64>().unwrap()..args[3].parse().unwrap();
    for seed in seeds {
        let t = std::time::Instant::now();
        let s = Settings::default();
        match args[1].as_str() {
            "pendulum" => {
                let file = pendulum(seed, 0.4, 0.15);
                let mass = 0.4 + [0.2, -0.15, 0.35][seed as usize % 3];
                let truth = pendulum(seed, mass, 0.15);
                let r = Recording { swing_rad: 1.5, ..Recording::default() };
                let servos = prepared::joints(&truth).unwrap();
                let mut c = record(&truth, &links_of(&truth), &servos, &r, seed);
                c.arm = file;
                let o = Outcome::of(&c, &s, &|_| ()).unwrap();
                show(&format!("pendulum {seed} {:+.3} {:?}", mass - 0.4, t.elapsed()), &o);
            }
            what => {
                let file = six_axes(seed);
                let mut servos = prepared::joints(&file).unwrap();
                let mut links = links_of(&file);
                let j = seed as usize % 6;
                match what {
                    "saturation" => servos[j].limit = 1.2,
                    "stribeck" => { servos[j].stribeck = 0.15; }
                    "dead" => servos[j].dead_zone = 0.3,
                    "offset" => servos[j].offset = 0.3,
                    "backlash" => servos[j].gap = 0.02,
                    "lag" => servos[j].lag_s = 0.03,
                    "asym" => servos[j].asymmetry = 0.3,
                    "spring" => servos[j].spring = 1.0,
                    "cogging" => servos[j].cogging = [0.2, 5.0, 0.7],
                    "load" => for s in &mut servos { s.motor_load_friction = 0.8; },
                    "load1" => servos[1 + j % 3].joint_load_friction = 1.0,
                    "payload" => links = Whole::Payload.links(&links, &[0.1, 0.03, 0.0, 0.0]),
                    "tilt" => links = Whole::BaseTilt.links(&links, &[0.1, -0.05]),
                    _ => {}
                }
                let mut c = record(&file, &links, &servos, &Recording::default(), seed);
                let _ = &mut c;
                let o = Outcome::of(&c, &s, &|_| ()).unwrap();
                show(&format!("{what} {seed} J{} {:?}", j+1, t.elapsed()), &o);
            }
        }
    }
}
