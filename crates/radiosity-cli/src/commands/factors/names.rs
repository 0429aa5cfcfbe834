//! Patches by their names.

/// The place of a name among others; a message that tells some of these, where it is none of them.
pub(super) fn place<'n>(
    mut names: impl Iterator<Item = &'n str> + Clone,
    name: &str,
) -> Result<usize, String> {
    let known: Vec<_> = names.clone().take(20).collect();
    let more = if names.clone().nth(20).is_some() { ", …" } else { "" };
    let found = names.position(|known| known == name);
    found.ok_or_else(|| format!("no patch is named {name}; the scene has {}{more}", known.join(", ")))
}
