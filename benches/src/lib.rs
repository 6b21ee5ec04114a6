//! Benchmarks of guardbit live in `benches/`.
