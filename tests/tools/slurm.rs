//! The job arrays of `recipes/slurm`, run as its README says on a cluster of one node.

use crate::run::{Ran, run_in};
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// All of the trial, the cluster's start included.
const LIMIT: Duration = Duration::from_mins(1);
const README: &str = include_str!("../../recipes/slurm/README.md");

/// A cluster that ends with this value.
struct Cluster {
    child: Child,
    /// Its slurm.conf, which lies in its folder.
    conf: PathBuf,
    /// The user's home of the README, with this repository and the command in it.
    home: tempfile::TempDir,
    begin: Instant,
}

impl Cluster {
    fn start() -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let begin = Instant::now();
        let mut command = Command::new("bash");
        command.arg(root.join("tests/slurm/cluster.sh"));
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let mut conf = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut conf).unwrap();
        assert!(conf.ends_with("slurm.conf\n"), "the cluster did not start: {conf:?}");
        let home = tempfile::tempdir().unwrap();
        std::os::unix::fs::symlink(root, home.path().join("guardbit")).unwrap();
        Self { child, conf: conf.trim_end().into(), home, begin }
    }

    fn path(&self, file: &str) -> PathBuf {
        self.home.path().join(file)
    }

    fn read(&self, file: &str) -> String {
        fs::read_to_string(self.path(file)).unwrap_or_else(|error| panic!("{file}: {error}"))
    }

    /// Runs a script as the README's user.
    fn shell(&self, script: &str) -> String {
        let mut command = Command::new("bash");
        // A trial that is itself a job of a cluster hands nothing of that on.
        let foreign = |name: &str| name.starts_with("SLURM") || name.starts_with("SBATCH");
        for (name, _) in std::env::vars().filter(|(name, _)| foreign(name)) {
            command.env_remove(name);
        }
        command.env("SLURM_CONF", &self.conf).env("HOME", self.home.path());
        command.env("GUARDBIT", env!("CARGO_BIN_EXE_guardbit"));
        command.current_dir(self.home.path()).stdin(Stdio::null());
        let ran: Ran = command.args(["-euo", "pipefail", "-c", script]).output().unwrap().into();
        ran.ends(0).out
    }

    fn until(&self, what: &str, reached: impl Fn() -> bool) {
        while !reached() {
            assert!(self.begin.elapsed() < LIMIT, "{what}: not within {LIMIT:?}");
            std::thread::sleep(Duration::from_millis(100));
        }
    }

    /// Waits until no job is left.
    fn drained(&self) {
        self.until("all jobs ended", || self.shell("squeue --noheader").is_empty());
    }

    /// Task or none, and how it ended, of each job of these two submissions.
    fn states(&self, submitted: &Submitted) -> Vec<(String, String)> {
        let jobs = self.shell("scontrol --oneliner show job");
        let field = |job: &str, name: &str| {
            let found = job.split(' ').find_map(|word| word.strip_prefix(name)).unwrap_or_default();
            found.to_owned()
        };
        let mut states: Vec<(String, String)> = Vec::new();
        for job in jobs.lines() {
            let (id, array) = (field(job, "JobId="), field(job, "ArrayJobId="));
            if array == submitted.array || id == submitted.merge {
                states.push((field(job, "ArrayTaskId="), field(job, "JobState=")));
            }
        }
        states.sort();
        states
    }

    /// Fails unless all jobs, so many parts and one that joins, came to a good end.
    fn succeeded(&self, folder: &str, submitted: &Submitted, parts: &[usize]) {
        let wanted = |task: String| (task, "COMPLETED".to_owned());
        let tasks = parts.iter().map(|part| wanted(part.to_string()));
        let all: Vec<_> = [wanted(String::new())].into_iter().chain(tasks).collect();
        let logs = || self.shell(&format!("cd {folder}; tail -n 20 *.log"));
        assert_eq!(self.states(submitted), all, "{}", logs());
        assert_eq!(self.read(&format!("{folder}/merge.log")), "");
    }

    /// Submits by two lines of the README, `parts` and `request` being set by `setup`.
    fn submit(&self, setup: &str, lines: &str) -> Submitted {
        let report = "printf '%s\\n' \"$array\" \"$parts\" \"${request[@]}\"";
        let out = self.shell(&format!("{setup}\n{lines}\n{report}"));
        let mut words = out.lines();
        let merge = words.next().unwrap().strip_prefix("Submitted batch job ").unwrap().to_owned();
        let (array, parts) = (words.next().unwrap().to_owned(), words.next().unwrap());
        Submitted {
            array,
            merge,
            parts: (0..parts.parse().unwrap()).collect(),
            request: words.collect::<Vec<_>>().join(" "),
        }
    }
}

impl Drop for Cluster {
    fn drop(&mut self) {
        // It lasts as long as its standard input.
        drop(self.child.stdin.take());
        let begin = Instant::now();
        while self.child.try_wait().is_ok_and(|ended| ended.is_none()) {
            if begin.elapsed() > Duration::from_secs(20) {
                let _ = self.child.kill();
            }
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}

/// An array and the job that waits for it.
struct Submitted {
    array: String,
    merge: String,
    parts: Vec<usize>,
    request: String,
}

/// The scripts of the README, in their order.
fn scripts() -> [&'static str; 4] {
    let scripts = README.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    scripts.collect::<Vec<_>>().try_into().unwrap()
}

pub(crate) fn scripts_are_clean(shellcheck: &str) {
    let mut command = Command::new(shellcheck);
    command.current_dir(env!("CARGO_MANIFEST_DIR")).arg("--shell=bash");
    command.args(["recipes/slurm/part.sbatch", "recipes/slurm/merge.sbatch"]);
    command.arg("recipes/mutation/mutate.sh");
    let ran = Ran::from(command.arg("tests/slurm/cluster.sh").output().unwrap());
    assert_eq!((ran.status, &*ran.out), (Some(0), ""));
}

pub(crate) fn arrays_do_what_the_readme_says(_: &str) {
    let cluster = Cluster::start();
    table_of_one_run(&cluster);
    answer_of_one_run(&cluster);
    stopped_part_goes_on(&cluster);
    wrong_numbers_are_named(&cluster);
    let (folder, taken) = (cluster.conf.parent().unwrap().to_owned(), cluster.begin.elapsed());
    drop(cluster);
    assert!(!folder.exists(), "the cluster leaves its folder");
    let left = fs::read_dir("/proc").unwrap().filter_map(|process| {
        let environment = fs::read(process.ok()?.path().join("environ")).ok()?;
        String::from_utf8_lossy(&environment).contains(folder.to_str()?).then_some(())
    });
    assert_eq!(left.count(), 0, "the cluster leaves a process");
    eprintln!("slurm: {:.1} s", taken.as_secs_f64());
    assert!(taken < LIMIT, "{taken:?}");
}

fn table_of_one_run(cluster: &Cluster) {
    let [setup, submit, ..] = scripts();
    let submitted = cluster.submit(setup, submit);
    cluster.drained();
    cluster.succeeded("knot", &submitted, &submitted.parts);
    for part in &submitted.parts {
        assert_eq!(cluster.read(&format!("knot/part-{part}.log")), "", "part {part}");
    }
    let table = cluster.read("knot/all.csv");
    let single = format!("{} --no-speed --csv", submitted.request);
    assert!(table == run_in(cluster.home.path(), &single).ends(0).out, "the tables differ");
    assert!(cluster.read("knot/report.html").ends_with("</html>\n"));
    // Each budget was measured in one part, and each part did its own.
    let lines = |part: &usize| cluster.read(&format!("knot/part-{part}.jsonl")).lines().count() - 1;
    let lines: Vec<usize> = submitted.parts.iter().map(lines).collect();
    assert_eq!(lines.iter().sum::<usize>(), table.lines().count() - 1, "{lines:?}");
    assert!(lines.iter().all(|count| *count > 0), "{lines:?}");
}

fn answer_of_one_run(cluster: &Cluster) {
    let [_, submit, setup, _] = scripts();
    let submitted = cluster.submit(setup, submit);
    cluster.drained();
    cluster.succeeded("knot-fit", &submitted, &submitted.parts);
    let best = json(&cluster.read("knot-fit/best.json"));
    let single = format!("{} --json --profile-out single.toml", submitted.request);
    let single = json(&run_in(cluster.home.path(), &single).ends(0).out);
    assert!(single["index"].is_u64() && single["cost"].is_f64(), "{single}");
    for key in ["budget", "index", "cost", "within", "witness", "larger"] {
        assert_eq!(best[key], single[key], "{key}");
    }
    assert_eq!(cluster.read("knot-fit/best.toml"), cluster.read("single.toml"));
    assert!(cluster.read("knot-fit/best.txt").contains("\nbudget "));
}

/// Stops a part while it measures, cuts its last line, and submits that part alone again.
fn stopped_part_goes_on(cluster: &Cluster) {
    let [_, submit, _, again] = scripts();
    let setup = "mkdir -p ~/long && cd ~/long && recipe=~/guardbit/recipes/slurm && parts=3
        request=(explore sgi-4k --scene knot --window 512x512
            --vary sub-pixel=4..9 --vary interpolation=2..13 --vary guard=0..2)";
    let submitted = cluster.submit(setup, submit);
    let file = "long/part-2.jsonl";
    let lines = || fs::read_to_string(cluster.path(file)).unwrap_or_default().lines().count();
    cluster.until("part 2 measures", || lines() > 4);
    cluster.shell(&format!("scancel {}_2", submitted.array));
    cluster.drained();
    let states = cluster.states(&submitted);
    let ended: Vec<_> = states.iter().map(|(task, state)| (&**task, &**state)).collect();
    let wanted = [("", "CANCELLED"), ("0", "COMPLETED"), ("1", "COMPLETED"), ("2", "CANCELLED")];
    assert_eq!(ended, wanted);
    assert!(!cluster.path("long/all.csv").exists());
    let log = cluster.read("long/part-2.log");
    assert!(log.contains("continue from part-2.jsonl"), "{log}");

    let text = cluster.read(file);
    let whole = text.trim_end_matches(|letter| letter != '\n');
    let (kept, last) = whole[..whole.len() - 1].rsplit_once('\n').unwrap();
    fs::write(cluster.path(file), format!("{kept}\n{}", &last[..last.len() / 2])).unwrap();
    let submitted = cluster.submit(setup, again);
    cluster.drained();
    cluster.succeeded("long", &submitted, &[2]);
    assert_eq!(cluster.read("long/part-2.log"), log, "nothing is added");
    assert!(cluster.read(file).starts_with(&format!("{kept}\n{last}\n")), "it went on");
    let single = format!("{} --no-speed --csv", submitted.request);
    let single = run_in(cluster.home.path(), &single).ends(0).out;
    assert!(cluster.read("long/all.csv") == single, "the tables differ");
}

/// More parts than budgets, and an array that does not begin at 0.
fn wrong_numbers_are_named(cluster: &Cluster) {
    let [_, submit, ..] = scripts();
    let setup = "mkdir -p ~/few && cd ~/few && recipe=~/guardbit/recipes/slurm && parts=3
        request=(explore tiny --scene triangle --vary guard=0..1)";
    let submitted = cluster.submit(setup, submit);
    let shifted = cluster.submit(
        &setup.replace("/few", "/shifted"),
        &submit.replace("--array=0-$((parts - 1))", "--array=1-$parts"),
    );
    cluster.drained();
    let good = cluster.states(&submitted);
    assert!(good.len() == 4 && good.iter().all(|(_, state)| state == "COMPLETED"), "{good:?}");
    assert!(
        cluster
            .read("few/part-0.log")
            .contains("note: this part of the space contains no valid budget")
    );
    let single = format!("{} --no-speed --csv", submitted.request);
    assert_eq!(cluster.read("few/all.csv"), run_in(cluster.home.path(), &single).ends(0).out);
    let bad = cluster.states(&shifted);
    let ended: Vec<_> = bad.iter().map(|(task, state)| (&**task, &**state)).collect();
    assert_eq!(ended, [("", "CANCELLED"), ("1", "FAILED"), ("2", "FAILED"), ("3", "FAILED")]);
    for part in 1..=3 {
        let log = cluster.read(&format!("shifted/part-{part}.log"));
        assert_eq!(log, "error: the parts are numbered from 0: --array=0-2 for 3 of them\n");
    }
}

fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).unwrap()
}
