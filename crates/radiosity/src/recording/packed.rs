//! Lists of numbers as text: base64 of their bytes, the lowest first.
use base64::{Engine, engine::general_purpose::STANDARD};
use serde::{Deserialize, Serialize};

/// The largest number of 16 bits with a sign.
const FULL: f64 = 32767.0;

/// Red, green and blue of many places, each as the signed root of its share of the largest: of 16 bits most then tell what is dark.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Packed {
    peak: f64,
    values: String,
}

impl Packed {
    #[allow(clippy::cast_possible_truncation, reason = "a share of 1 times the largest")]
    pub(super) fn new(rows: &[[f64; 3]]) -> Packed {
        let peak = rows.iter().flatten().fold(0.0f64, |peak, value| peak.max(value.abs()));
        let share = if peak > 0.0 { peak } else { 1.0 };
        let root = |value: &f64| (value.signum() * (value.abs() / share).sqrt() * FULL).round() as i16;
        let bytes = rows.iter().flatten().flat_map(|value| root(value).to_le_bytes());
        Packed { peak, values: STANDARD.encode(bytes.collect::<Vec<u8>>()) }
    }

    /// How long the text is.
    pub(super) fn bytes(&self) -> usize {
        self.values.len()
    }

    /// The colours; nothing when the text holds none.
    pub(super) fn rows(&self) -> Option<Vec<[f64; 3]>> {
        let value = |bytes: [u8; 2]| {
            let root = f64::from(i16::from_le_bytes(bytes)) / FULL;
            self.peak * root * root.abs()
        };
        let values: Vec<f64> = words(&self.values)?.into_iter().map(value).collect();
        let sound = values.len() % 3 == 0 && self.peak.is_finite() && self.peak >= 0.0;
        sound.then(|| values.chunks_exact(3).map(|row| [row[0], row[1], row[2]]).collect())
    }
}

/// The bytes of a text, so many at a time.
fn words<const N: usize>(text: &str) -> Option<Vec<[u8; N]>> {
    let bytes = STANDARD.decode(text).ok()?;
    let words = bytes.chunks(N).map(|word| <[u8; N]>::try_from(word).ok());
    words.collect()
}

/// Indices as text.
pub(super) fn index_text(indices: impl Iterator<Item = usize>) -> String {
    let bytes = indices.flat_map(|index| u32::try_from(index).unwrap_or(u32::MAX).to_le_bytes());
    STANDARD.encode(bytes.collect::<Vec<u8>>())
}

/// The indices in a text.
pub(super) fn indices(text: &str) -> Option<Vec<u32>> {
    Some(words(text)?.into_iter().map(u32::from_le_bytes).collect())
}

/// Numbers as text.
pub(super) fn number_text(numbers: impl Iterator<Item = f64>) -> String {
    STANDARD.encode(numbers.flat_map(f64::to_le_bytes).collect::<Vec<u8>>())
}

/// The numbers in a text.
pub(super) fn numbers(text: &str) -> Option<Vec<f64>> {
    Some(words(text)?.into_iter().map(f64::from_le_bytes).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_come_back_within_a_share_of_themselves() {
        let rows = [[1.0, 0.0, -0.25], [1e-3, 1e-6, 0.5]];
        let again = Packed::new(&rows).rows().expect("colours");
        for (row, again) in rows.iter().zip(&again) {
            for (value, again) in row.iter().zip(again) {
                assert!((value - again).abs() <= 4e-5 * value.abs().sqrt() + 1e-9, "{value} {again}");
            }
        }
        assert_eq!(Packed::new(&[[0.0; 3]; 2]).rows(), Some(vec![[0.0; 3]; 2]));
    }

    #[test]
    fn numbers_and_indices_come_back_bit_for_bit() {
        assert_eq!(numbers(&number_text([0.1, -0.0].into_iter())).map(|n| n[1].to_bits()), Some(1 << 63));
        assert_eq!(indices(&index_text([7, 70_000].into_iter())), Some(vec![7, 70_000]));
        assert!(numbers("AAAA").is_none() && indices("?").is_none());
        assert!(Packed { peak: 1.0, values: "AAA=".to_owned() }.rows().is_none());
    }
}
