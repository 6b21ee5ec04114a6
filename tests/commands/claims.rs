//! Every known fact, recomputed: `guardbit claims` as a test, spread over the machine's threads.

use guardbit::explore::claims::{Claim, all};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

#[test]
fn every_claim_holds() {
    let (statements, next) = (all(), AtomicUsize::new(0));
    let claims: Mutex<Vec<Claim>> = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some(statement) = statements.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let claim = statement.check();
                    claims.lock().unwrap().push(claim);
                }
            });
        }
    });
    let claims = claims.into_inner().unwrap();
    assert_eq!(claims.len(), statements.len());
    let wrong: Vec<&Claim> = claims.iter().filter(|claim| !claim.good).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}
