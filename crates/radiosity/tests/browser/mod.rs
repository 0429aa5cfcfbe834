//! Pages in a headless browser: what a script that was put into a page reports.
//!
//! Needs `chromium` (Debian: `apt-get install chromium`) or the program that CHROMIUM names; tests that find none say so and
//! check nothing.
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// The browser, if there is one.
pub(crate) fn browser() -> Option<String> {
    let asked = std::env::var("CHROMIUM").ok();
    let names = asked.into_iter().chain(["chromium", "chromium-browser", "google-chrome"].map(Into::into));
    let found = names.into_iter().find(|name| Command::new(name).arg("--version").output().is_ok());
    if found.is_none() {
        eprintln!("no chromium: the page was not looked at");
    }
    found
}

/// What the script of `folder`'s `page.html` leaves as the page's text: `<pre>REPORT:` and JSON.
pub(crate) fn reported(browser: &str, folder: &Path, flags: &[&str]) -> Value {
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-dev-shm-usage", "--dump-dom"])
        .args(flags)
        .arg(format!("--user-data-dir={}", folder.display()))
        .arg(format!("file://{}", folder.join("page.html").display()))
        .output()
        .expect("it could tell its version");
    let dom = String::from_utf8_lossy(&output.stdout).into_owned();
    let report = dom.split("<pre>REPORT:").nth(1).and_then(|rest| rest.split("</pre>").next());
    let report = report.unwrap_or_else(|| {
        panic!("the page did not come to its end: {}", String::from_utf8_lossy(&output.stderr))
    });
    serde_json::from_str(report).expect("the script writes JSON")
}
