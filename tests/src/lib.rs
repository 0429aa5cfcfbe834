//! Corpora, generators and independent oracles shared by the test suites.
