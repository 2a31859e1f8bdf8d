use super::*;

const BX_LR: u16 = 0x4770;
const BLX_R3: u16 = 0x4798;

/// `bl` over this many bytes, from the instruction's own address.
fn bl(distance: u16) -> [u16; 2] {
    [0xf000, 0xf800 | ((distance - 4) >> 1)]
}

fn code(halfwords: &[u16], functions: &[(u32, u32, &str)], data: &[(u32, &str)]) -> Code<'static> {
    let bytes: Vec<u8> = halfwords.iter().flat_map(|halfword| halfword.to_le_bytes()).collect();
    Code::from_parts(bytes.leak(), functions, data)
}

/// `tick` calls `helper`, which calls `leaf`; nobody calls `other`, but a word of
/// data in `tick` looks like such a call.
fn example() -> Code<'static> {
    let [helper_high, helper_low] = bl(12);
    let [leaf_high, leaf_low] = bl(6);
    let [other_high, other_low] = bl(14);
    let tick = [helper_high, helper_low, BX_LR, other_high, other_low, BX_LR];
    let helper_and_leaf = [leaf_high, leaf_low, BX_LR, BX_LR];
    let halfwords = [&tick[..], &helper_and_leaf, &[BX_LR]].concat();
    let functions = [(0, 12, "tick"), (12, 6, "helper"), (18, 2, "leaf"), (20, 2, "other")];
    code(&halfwords, &functions, &[(0, "$t"), (6, "$d"), (10, "$t.1")])
}

fn follow(code: &Code<'_>) -> Result<Reached> {
    Reached::from(&[0], code, |_| false)
}

fn names(code: &Code<'_>, addresses: impl IntoIterator<Item = u32>) -> Vec<String> {
    let functions = addresses.into_iter().filter_map(|address| code.function(address));
    functions.map(|function| function.name().to_owned()).collect()
}

#[test]
fn calls_are_followed_and_data_is_not_taken_for_calls() {
    let code = example();
    let reached = follow(&code).expect("all can be followed");
    assert_eq!(names(&code, reached.functions()), ["tick", "helper", "leaf"]);
    assert_eq!(names(&code, reached.path(18)), ["tick", "helper", "leaf"]);
}

#[test]
fn the_call_that_leads_to_a_function_is_told() {
    let reached = follow(&example()).expect("all can be followed");
    assert_eq!(reached.call_of(0), None);
    assert_eq!(reached.call_of(18), Some(Call { caller: 12, site: 12 }));
}

#[test]
fn nothing_is_followed_out_of_an_end() {
    let code = example();
    let reached = Reached::from(&[0], &code, |function| function.name() == "helper");
    let reached = reached.expect("all can be followed");
    assert_eq!(names(&code, reached.functions()), ["tick", "helper"]);
}

#[test]
fn a_call_through_a_pointer_is_refused() {
    let code = code(&[BLX_R3, BX_LR], &[(0, 4, "tick")], &[]);
    let error = follow(&code).expect_err("it could call anything").to_string();
    assert!(error.starts_with("tick jumps to a computed address at 0x0"), "{error}");
}

#[test]
fn a_call_to_nowhere_is_refused() {
    let [high, low] = bl(100);
    let code = code(&[high, low, BX_LR], &[(0, 6, "tick")], &[]);
    let error = follow(&code).expect_err("nothing is there").to_string();
    assert_eq!(error, "tick jumps at 0x0 to 0x64, where no function is");
}

#[test]
fn a_function_of_unknown_extent_is_refused() {
    let code = code(&[BX_LR], &[(0, 0, "tick")], &[]);
    let error = follow(&code).expect_err("it could go on anywhere").to_string();
    assert_eq!(error, "tick has no size in the symbol table");
}
