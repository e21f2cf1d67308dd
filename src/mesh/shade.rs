//! Colours of utilisation.

/// Viridis (matplotlib, CC0) from its light end, linear between nine of its colours: what is used fully stands out on white; red above 1.
/// Grey where it is no number.
pub fn shade(value: f64) -> [u8; 3] {
    const STOPS: [[f64; 3]; 9] = [
        [68., 1., 84.],
        [71., 44., 122.],
        [59., 81., 139.],
        [44., 113., 142.],
        [33., 144., 141.],
        [39., 173., 129.],
        [92., 200., 99.],
        [170., 220., 50.],
        [253., 231., 37.],
    ];
    if value.is_nan() {
        return GREY;
    }
    if value > 1.0 + 1e-6 {
        return [0xd6, 0x27, 0x28];
    }
    let at = (1.0 - value.clamp(0.0, 1.0)) * 8.0;
    let k = (at as usize).min(7);
    let t = at - k as f64;
    std::array::from_fn(|c| (STOPS[k][c] * (1.0 - t) + STOPS[k + 1][c] * t).round() as u8)
}

/// What has no utilisation.
pub const GREY: [u8; 3] = [0x99; 3];
