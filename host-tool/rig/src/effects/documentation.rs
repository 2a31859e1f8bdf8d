//! `docs/effects.md`, written from the catalogue.

use super::catalogue::Catalogue;
use super::compensation::Compensation;
use super::confusion::{Confused, Confusion};
use super::definition::Definition;
use super::search::{Carrier, Search};
use super::table::{FEWEST_TABLE_KNOTS, MAX_TABLE_KNOTS, TableAxis, board_axis};
use firmware::compensation::{MAX_KNOTS, MAX_TABLES, limits};

const HEAD: &str = "\
# The catalogue of effects

What a real robot may do and the model does not hold. `rrr simulate --effect` adds them to the
simulated robot, `[[effect]]` tables to a model. u is the command, q the joint's position as its encoder reads
it, qd its velocity, n the number of periods per turn, phi a phase, k_t the torque constant, gamma the
level of friction, alpha2 viscous friction, c + h the torque of Coriolis forces and gravity, J the tip's
Jacobian, theta the motor's angle, t time; a prime is a derivative in time. Other letters are the
effect's parameters. Each has a file in `host-tool/rig/src/effects/catalogue/`, from which this
page is written (`RRR_WRITE_DOCS=1 cargo test -p rig docs_effects_md`); several act in the order in
which they are given.

    rrr simulate --model model.toml --dataset gap --out logs \\
        --effect cogging:3:amplitude_V=0.11,harmonic=8,phase_rad=0.9 --effect payload:mass_kg=0.3
";

const SHOWN: &str = "
## What shows them, and what the board compensates for

An effect changes what drives the joint, its friction or what the rigid body needs, in the equation
of the [diagnosis](diagnosis.md). The board compensates for it by feedforward, by sending the command
through the inverse of the effect, or in the model that it computes with
([firmware.md](firmware.md#compensation-of-effects-that-the-model-lacks)).
";

const CONFUSED: &str = "
## What is taken for what

What logs cannot tell apart, or only just, why, and what would settle it. *Compared*: where the logs
of a diagnosis do not tell the two apart it says so. *Twins*: one thing under two names, so no blind
trial hides both on a joint.
";

const TABLES: &str = "
## Curves without a cause: `table`

What remains of a gap once its causes are named, in a form that simulator and board can play: a curve
over one axis, added to u. It names no cause, so neither the search nor the blind trials use it. A model
file or `--effect` gives it to one joint; a joint may have several:

    [[effect]]
    effect = \"table\"
    joint = 2
    [effect.parameters]
    axis = \"velocity\"
    knots = [-0.2, -0.05, 0.05, 0.2]
    values_V = [0.0, 0.05, -0.05, 0.0]

    --effect 'table:2:axis=velocity,knots=-0.2 -0.05 0.05 0.2,values_V=0 0.05 -0.05 0'
";

const TABLE_RULES: &str = "
The curve is linear between its knots and constant beyond the first and the last. It has FEWEST to MOST
knots, which increase, and as many values, from LOWEST to HIGHEST V. The board plays ON_BOARD of them on
a joint, MAX_KNOTS knots each; of a finer curve it leaves out the knots that are missed least, and
`--compensate` says by how much its curve is off.
";

const OF_ARMS: &str = "
## On an arm of any kind

An arm of format 2 ([mechanisms.md](mechanisms.md)) has all of the above, some of them in other terms, and
more. Its joints may slide and its drives take other units; names keep `_V` and `_rad`. The board drives the
three-joint robot alone, so it compensates for nothing on such an arm. What position servos have:
[servo-arms.md](servo-arms.md#simulated-with-hidden-effects).
";

/// The page of the effects of the robot and of those that arms of any kind have, in Markdown.
pub fn markdown(catalogue: &Catalogue, of_arms: &Catalogue) -> String {
    let others = || of_arms.iter().filter(|effect| !catalogue.iter().any(|own| same(own, effect)));
    let arms = table(WHAT, others().map(what_it_is));
    let [on_arms @ .., _] = SHOWS;
    let shown_of_arms = table(on_arms, others().map(how_it_shows_on_an_arm));
    let what = table(WHAT, catalogue.iter().map(what_it_is));
    let shown = table(SHOWS, catalogue.iter().map(how_it_shows));
    let is_new = |effect: &&Definition| catalogue.by_name(effect.name).is_none();
    let all = catalogue.iter().chain(of_arms.iter().filter(|effect| is_new(effect)));
    let confused = all.flat_map(|definition| {
        definition.confused_with.iter().map(|confusion| confusion_row(definition, confusion))
    });
    let confused = table(["this", "or that", "why", "told apart by", ""], confused);
    let rest = [TABLES, "\n", &table_axes(), &table_rules()].concat();
    let arms = [OF_ARMS, "\n", &arms, "\n", &shown_of_arms].concat();
    [HEAD, "\n", &what, SHOWN, "\n", &shown, &arms, CONFUSED, "\n", &confused, &rest].concat()
}

const WHAT: [&str; 5] =
    ["effect", "acts on", "what it is", "equation", "parameters and their bounds"];
const SHOWS: [&str; 7] = [
    "effect",
    "changes",
    "of",
    "the search begins",
    "a stronger one has",
    "shown best by",
    "the board",
];

/// Whether two are one definition, with the same bounds.
fn same(one: &Definition, other: &Definition) -> bool {
    one.name == other.name && one.equation == other.equation && parameters(one) == parameters(other)
}

fn table_axes() -> String {
    let row =
        |axis: TableAxis| [code(axis.name()), axis.unit().into(), axis.words().into(), plays(axis)];
    table(["axis", "knots in", "x", "the board"], TableAxis::ALL.into_iter().map(row))
}

fn plays(axis: TableAxis) -> String {
    board_axis(axis).map_or_else(|why| format!("no: {why}"), |_| "feedforward".into())
}

fn table_rules() -> String {
    let replaced = [
        ("FEWEST", FEWEST_TABLE_KNOTS.to_string()),
        ("MOST", MAX_TABLE_KNOTS.to_string()),
        ("LOWEST", limits::TABLE_V.lowest.to_string()),
        ("HIGHEST", limits::TABLE_V.highest.to_string()),
        ("ON_BOARD", MAX_TABLES.to_string()),
        ("MAX_KNOTS", MAX_KNOTS.to_string()),
    ];
    replaced.iter().fold(TABLE_RULES.to_owned(), |text, (name, value)| text.replace(name, value))
}

fn what_it_is(definition: &Definition) -> [String; 5] {
    [
        code(definition.name),
        if definition.whole_robot { "robot" } else { "joint" }.into(),
        definition.words.into(),
        definition.equation.into(),
        parameters(definition),
    ]
}

/// The parameters with their bounds, a vector's components as one.
fn parameters(definition: &Definition) -> String {
    let one = |name: &str| {
        let mut components = definition.parameters.iter().filter(|p| p.name == name);
        let first = components.next()?;
        let each = if components.next().is_some() { " each of [x, y, z]" } else { "" };
        let optional = if first.optional { ", 0 where left out" } else { "" };
        Some(format!("`{name}` {} to {}{each}{optional}", first.lowest, first.highest))
    };
    definition.parameter_names().into_iter().filter_map(one).collect::<Vec<_>>().join("<br>")
}

fn how_it_shows(definition: &Definition) -> [String; 7] {
    let touches = definition.touches;
    let changes =
        [(touches.drive, "drive"), (touches.friction, "friction"), (touches.body, "body")];
    let changes = changes.into_iter().filter_map(|(does, what)| does.then_some(what));
    let larger = if definition.size.grows { "larger" } else { "smaller" };
    [
        code(definition.name),
        changes.collect::<Vec<_>>().join(", "),
        if definition.couples_joints { "all joints" } else { "its joint" }.into(),
        searched(definition.search).into(),
        format!("a {larger} `{}`", definition.parameters[0].name),
        definition.experiment.into(),
        board(definition.compensation),
    ]
}

/// The same without the board, which drives no such arm.
fn how_it_shows_on_an_arm(definition: &Definition) -> [String; 6] {
    let [on_arms @ .., _] = how_it_shows(definition);
    on_arms
}

fn searched(search: Search) -> &'static str {
    match search {
        Search::From(_) => "from start values",
        Search::Harmonics(Carrier::Unity) => "at every order",
        Search::Harmonics(Carrier::Command) => "at every order of the command",
        Search::Harmonics(Carrier::Friction) => "at every order of friction",
    }
}

fn board(compensation: Compensation) -> String {
    match compensation {
        Compensation::Feedforward(_) => "feedforward".into(),
        Compensation::Inverse(_) => "inverse".into(),
        Compensation::Model(_) => "in its model".into(),
        Compensation::None(why) => format!("no: {why}"),
    }
}

fn confusion_row(definition: &Definition, confusion: &Confusion) -> [String; 5] {
    let notes = [(confusion.compared, "compared"), (confusion.never_paired, "twins")];
    let notes = notes.into_iter().filter_map(|(is, note)| is.then_some(note));
    [
        code(definition.name),
        match confusion.with {
            Confused::Effect(name) => code(name),
            Confused::Model(part) => part.into(),
        },
        confusion.why.into(),
        confusion.told_apart_by.into(),
        notes.collect::<Vec<_>>().join(", "),
    ]
}

fn code(name: &str) -> String {
    format!("`{name}`")
}

fn table<const N: usize>(header: [&str; N], rows: impl Iterator<Item = [String; N]>) -> String {
    let line = |cells: [String; N]| format!("| {} |\n", cells.join(" | "));
    let escaped = |row: [String; N]| row.map(|cell| cell.replace('|', "&#124;"));
    let head = line(header.map(str::to_owned)) + &line(header.map(|_| "---".to_owned()));
    rows.fold(head, |text, row| text + &line(escaped(row)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn docs_effects_md_is_what_the_catalogue_says() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/effects.md");
        let page = markdown(&Catalogue::standard(), &Catalogue::of_arm(3));
        if std::env::var_os("RRR_WRITE_DOCS").is_some() {
            std::fs::write(path, &page).unwrap();
        }
        let found = std::fs::read_to_string(path).unwrap();
        assert!(found == page, "write it: RRR_WRITE_DOCS=1 cargo test -p rig docs_effects_md");
    }
}
