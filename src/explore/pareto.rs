//! The Pareto front: the budgets for which no other budget is at least as good in all metrics and better
//! in one metric. Spec clause `Q-5`.

use super::metric::Metric;
use super::record::Record;

/// Marks the records that are on the Pareto front of these objectives: for each other record they
/// are better in one objective, or equal in all. An objective that a record has no figure for
/// counts as the worst there is.
pub fn mark(records: &mut [Record], objectives: &[Metric]) {
    let figures: Vec<Vec<f64>> = records
        .iter()
        .map(|record| objectives.iter().map(|m| m.of(record).unwrap_or(f64::INFINITY)).collect())
        .collect();
    let mut order: Vec<usize> = (0..records.len()).collect();
    order.sort_by(|a, b| {
        let pairs = figures[*a].iter().zip(&figures[*b]);
        pairs.map(|(x, y)| x.total_cmp(y)).find(|o| o.is_ne()).unwrap_or_else(|| a.cmp(b))
    });
    // Whoever beats a record comes before it, and so does somebody of the front who beats it.
    let mut front: Vec<usize> = Vec::new();
    for n in order {
        let beaten = front.iter().any(|other| beats(&figures[*other], &figures[n]));
        records[n].pareto = !beaten;
        if !beaten {
            front.push(n);
        }
    }
}

/// As good in everything and better in something.
fn beats(one: &[f64], other: &[f64]) -> bool {
    let mut pairs = one.iter().zip(other);
    pairs.clone().all(|(a, b)| a <= b) && pairs.any(|(a, b)| a < b)
}

#[cfg(test)]
mod tests {
    use super::beats;

    #[test]
    fn beating_is_strict_somewhere_and_worse_nowhere() {
        assert!(beats(&[1.0, 2.0], &[1.0, 3.0]));
        assert!(!beats(&[1.0, 2.0], &[1.0, 2.0]), "equals do not beat each other");
        assert!(!beats(&[1.0, 4.0], &[2.0, 3.0]));
    }
}
