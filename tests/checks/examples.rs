//! Worked examples.

use super::{Bar, largest};

fn near(found: f64, wanted: f64, tolerance: f64, what: &str) {
    assert!((found / wanted - 1.0).abs() <= tolerance, "{what}: {found}, not {wanted}");
}

const COLUMN: &str = "code = \"EN 1993-1-1\"\nfy = \"material.fy235\"\ngamma_M1 = 1\nstress_unit = 1\nclass = 1\nweb = \"compression\"\n\
    buckling = { y = { length = \"length\", curve = \"b\" }, z = { length = \"0.7*length\", curve = \"c\" } }";

/// Steel Buildings in Europe, Multi-storey steel buildings part 4 (ArcelorMittal, Peiner Träger, Corus), worked example A.5: HE 300 B of S235, 8 m,
/// L_cr,y = 8.00 m, L_cr,z = 5.60 m. It prints, from A = 149 cm², Iy = 25 170 cm⁴, Iz = 8560 cm⁴,
/// N_cr,y = 8151.2 kN, N_cr,z = 5657.4 kN, λ̄_y = 0.655, λ̄_z = 0.787, curve b: Φ_y = 0.792, χ_y = 0.808.
/// By hand with the profile's own A = 14 907.779 mm², Iy = 2.516568e8, Iz = 8.562830e7 mm⁴:
/// λ̄_y = √(14 907.779·235/8 149 814.6) = 0.655642, χ_y = 0.808155537, N_b,y = 2 831 233.96 N;
/// λ̄_z = √(14 907.779·235/5 659 268.9) = 0.786793, curve c (α = 0.49): χ_z = 0.670451075, N_b,z = 2 348 810.06 N.
#[test]
fn a_column_of_steel_buildings_in_europe() {
    let column = Bar {
        length: 8000.0,
        forces: [2e6, 0.0, 0.0],
        kind: "h-beam",
        dimensions: "tw = 11\nb = 300\nh = 300\ntf = { lower = 10, upper = 30, start = 19 }\nr = 27",
        check: COLUMN,
        minimize: "volume",
    };
    let subject = column.subject();
    // A row is N − N_b,Rd.
    let resistance = |clause: &str| 2e6 - largest(&subject, clause);
    near(resistance("6.3.1 y"), 2_831_233.963_4, 1e-9, "N_b,y");
    near(resistance("6.3.1 z"), 2_348_810.060_8, 1e-9, "N_b,z");
    near(resistance("6.3.1 cap"), 14_907.778_959_5 * 235.0, 1e-9, "N_pl");
    // The example's own figures: χ_y·A·fy with χ_y = 0.808 of A = 149 cm².
    near(resistance("6.3.1 y"), 0.808 * 14_900.0 * 235.0, 1e-3, "N_b,y as printed");
}

fn beam_column(class: u8, clause: &str) -> String {
    format!(
        "code = \"EN 1993-1-1\"\nfy = \"material.fy\"\ngamma_M1 = 1\nstress_unit = 1\nclass = {class}\nweb = \"bending\"\n\
         buckling = {{ y = {{ length = \"length\", curve = \"a\" }}, z = {{ length = \"length\", curve = \"b\" }} }}\n\
         ltb = {{ length = \"length\", C1 = 1, curve = \"b\"{clause} }}\nCm = {{ y = 0.64, z = 0.52, LT = 1 }}"
    )
}

const ROLLED: &str = ", clause = \"6.3.2.3\", lambda_LT0 = 0.4, beta = 0.75";

/// IPE 200 of S355, 3 m, N = 200 kN, My = 20 kNm, Mz = 5 kNm, C_my = 0.64, C_mz = 0.52, C_mLT = 1, curves a, b and b: checks 18 and 22 of
/// github.com/alezen9/themis, packages/ndg-ec3/benchmarks/ec3 (commit 3811fec7), which from table values A = 2848, Iy = 1943e4, Iz = 142.4e4, It = 6.98e4,
/// Iw = 12 990e6 and G = 81 000 print N_b,z = 265 998.96 N, M_b = 44 786 561.8 Nmm (6.3.2.3), n_z = 0.751 883, k_zy·m_y = 0.401 794 and k_zz = 1.067 371.
/// (Its W_pl,z is not that of the profile, so the third term is not.)
///
/// By hand with the profile's own A = 2848.410 658, Iy = 19 431 682.51, Iz = 1 423 683.273, W_pl,y = 220 638.647, W_pl,z = 44 612.158, It = 69 801.201,
/// Iw = 12 988 088 541.7 and G = E/2.6: λ̄_y = 0.475 359, χ_y = 0.931 751 721; λ̄_z = 1.756 186, χ_z = 0.263 011 477; M_cr = 53 188 876.7;
/// class 1, 6.3.2.3: λ̄_LT = 1.213 513, χ_LT = 0.571 461 787, (6.61) 0.717 160 669 740, (6.62) 1.491 038 857 557;
/// class 1, 6.3.2.2: χ_LT = 0.470 846 720, 0.781 840 285 610, 1.576 946 028 739;
/// class 3, 6.3.2.3: λ̄_LT = 1.138 830, χ_LT = 0.615 194 115, 0.905 432 230 374, 1.572 940 843 380;
/// class 3, 6.3.2.2: χ_LT = 0.512 405 150, 0.969 600 568 512, 1.662 740 437 681.
#[test]
fn a_beam_column_by_annex_b() {
    for (class, clause, moment, first, second) in [
        (1, ROLLED, 44_760_727.2, 0.717_160_669_740, 1.491_038_857_557),
        (1, "", 36_879_879.1, 0.781_840_285_610, 1.576_946_028_739),
        (3, ROLLED, 42_437_611.4, 0.905_432_230_374, 1.572_940_843_380),
        (3, "", 35_346_974.4, 0.969_600_568_512, 1.662_740_437_681),
    ] {
        let check = beam_column(class, clause);
        let bar = Bar {
            length: 3000.0,
            forces: [200e3, 20e6, 5e6],
            kind: "h-beam",
            dimensions: "tw = 5.6\nb = 100\nh = 200\ntf = { lower = 5, upper = 20, start = 8.5 }\nr = 12",
            check: &check,
            minimize: "volume",
        };
        let subject = bar.subject();
        near(200e3 - largest(&subject, "6.3.1 z"), 265_953.466, 1e-8, "N_b,z");
        near(200e3 - largest(&subject, "6.3.1 z"), 265_998.96, 2e-4, "N_b,z as printed");
        let alone = if clause.is_empty() { "6.3.2.2" } else { "6.3.2.3" };
        near(20e6 - largest(&subject, alone), moment, 1e-8, "M_b");
        near(largest(&subject, "6.61"), first, 1e-10, "(6.61)");
        near(largest(&subject, "6.62"), second, 1e-10, "(6.62)");
    }
}

/// AISC Design Examples, E.1A: W14×132 of A992 (Fy = 50 ksi), K·L = 30 ft, A = 38.8 in², ry = 3.76 in: φ_c·P_n = 893 kips.
/// By hand with Iy = 548 in⁴: Fe = π²·29 000·548/(38.8·360²) = 31.1919 ksi, F_cr = 0.658^(50/31.1919)·50 = 25.561 688, 0.9·F_cr·38.8 = 892.614 143.
#[test]
fn a_column_of_the_aisc_design_examples() {
    let text = "minimize = \"volume\"\n[structure]\n[materials.S]\nE = 29e3\nFy = 50\n[nodes]\na = [0, 0, 0]\nb = [0, 0, 360]\n\
        [supports]\na = \"pinned\"\nb = [\"x\", \"y\"]\n\
        [sections.s]\nkind = \"general\"\nA = { lower = 1, upper = 100, start = 38.8 }\nIx = 1530\nIy = 548\nJ = 12.3\n\
        [[ribs]]\nname = \"bar\"\nstart = \"a\"\nend = \"b\"\nsection = \"s\"\njoints = \"pinned\"\n\
        [[loads]]\ncase = \"P\"\nnodes = [\"b\"]\nforce = [0, 0, -840]\n\
        [[checks]]\nname = \"k\"\ncode = \"AISC 360-22\"\nribs = \"bar\"\ncases = \"P\"\nfy = \"material.Fy\"\nphi = 0.9\nmade = \"rolled\"\n\
        buckling = { y = { length = \"length\" }, z = { length = \"length\" } }\n";
    let subject = ribopt::run::Subject::of_text("aisc.toml", text).unwrap_or_else(|error| panic!("{error}"));
    let strength = 840.0 - largest(&subject, "E3-2 z");
    near(strength, 892.614_142_9, 1e-9, "phi Pn");
    near(strength, 893.0, 1e-3, "phi Pn as printed");
}
