# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs an archive by each of the four ways, killed twice, and holds it against single calls: batch.py FOLDER COUNT

Needs BATTEN_CLI. Ends with 1 at the first difference. A way that cannot start here is named and passed over.
"""
import collections
import json
import os
import resource
import shutil
import signal
import socket
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
RECIPES = os.path.join(HERE, "..", "..", "resources", "batch")
CLI = os.environ["BATTEN_CLI"]
TIMEOUT = float(os.environ.get("BATTEN_BATCH_TIMEOUT", "20"))
OPTIONS = "--page-timeout %g" % TIMEOUT
WAYS = os.environ.get("BATTEN_BATCH_WAYS", "").split()
PROCESSORS = len(os.sched_getaffinity(0))
THREADS = max(1, PROCESSORS // 2)
folder, count = os.path.abspath(sys.argv[1]), int(sys.argv[2])


def fail(text):
    sys.exit("FAILED: " + text)


def pages_of(place):
    with open(os.path.join(place, "pages.jsonl")) as file:
        return [json.loads(line) for line in file]


def results_of(place, name):
    path = os.path.join(place, name)
    if not os.path.exists(path):
        return []
    with open(path) as file:
        return [json.loads(line) for line in file if line.endswith("\n")]


def processor_seconds():
    """Of all processes that this one started and that have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


class OtherWork:
    """How many processors have worked for others than this program and its children since this object was made."""

    def __init__(self):
        self.begin, self.busy, self.own = time.time(), self.busy_seconds(), self.own_seconds()

    @staticmethod
    def busy_seconds():
        with open("/proc/stat") as file:
            user, nice, system, _, _, irq, softirq, steal = map(int, file.readline().split()[1:9])
        return (user + nice + system + irq + softirq + steal) / os.sysconf("SC_CLK_TCK")

    @staticmethod
    def own_seconds():
        usage = resource.getrusage(resource.RUSAGE_SELF)
        return processor_seconds() + usage.ru_utime + usage.ru_stime

    def processors(self):
        return max(0.0, (self.busy_seconds() - self.busy - self.own_seconds() + self.own) / (time.time() - self.begin))


def single_calls(place):
    """What each page gives alone: {scan: (status, error)} and the most MB that a call held; the outputs stay in `place`.

    A call has as many threads as one of two at once has in a batch."""
    told = {}
    for page in pages_of(place):
        words = [CLI, "trace", page["scan"], "--dpi", str(page["dpi"]), "--threads", str(THREADS)]
        for name, value in page.get("set", {}).items():
            words += ["--set", "%s=%s" % (name, value)]
        for output in page["outputs"]:
            words += ["-o", output]
        try:
            done = subprocess.run(words, cwd=place, capture_output=True, text=True, timeout=TIMEOUT)
            status = {0: "done", 4: "empty"}.get(done.returncode, "failed")
            told[page["scan"]] = (status, done.stderr.strip().removeprefix("batten-cli: "))
        except subprocess.TimeoutExpired:
            told[page["scan"]] = ("failed", "It took longer than %g s. Raise --page-timeout." % TIMEOUT)
    return told, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024 / 1e6


def expected_kinds():
    """The pages that make_pages.py makes so: ten empty, five damaged, one too long and one not to be written, of 200."""
    slow, unwritable = count // 2, count // 3
    damaged = [i for i in range(count) if i % 40 == 13 and i not in (slow, unwritable)]
    empty = [i for i in range(count) if i % 20 == 7 and i not in (slow, unwritable) and i not in damaged]
    failed = len(damaged) + 2
    return {"done": count - len(empty) - failed, "empty": len(empty), "failed": failed}


def start(words, place, **more):
    os.environ["BATTEN_CLI"] = CLI
    return subprocess.Popen(words, cwd=place, stdout=subprocess.DEVNULL, stderr=open(os.path.join(place, "log"), "ab"),
                            stdin=subprocess.DEVNULL, env=dict(os.environ, BATTEN_OPTIONS=OPTIONS), **more)


def kill_when(process, place, results, lines):
    """kill -9 once so many pages have been told of; True if it came in time."""
    while process.poll() is None:
        if len(results_of(place, results)) >= lines:
            process.send_signal(signal.SIGKILL)
            process.wait()
            return True
        time.sleep(0.02)
    return False


def run_killed_twice(words, place, results, before_restart=None):
    kills = 0
    for share in (0.3, 0.6):
        kills += kill_when(start(words, place), place, results, int(share * count))
        if before_restart:
            before_restart(place)
    start(words, place).wait()
    if kills != 2:
        fail("%s ended before it was killed twice" % words[0])


def wait_for(process):
    """The most MB that the process, or one that it started and saw end, held: one that was killed is counted, too."""
    usage = os.wait4(process.pid, 0)[2]
    process.returncode = 0  # nobody waits for it again
    return usage.ru_maxrss * 1024 / 1e6


def by_batch(place):
    run_killed_twice([CLI, "batch", "pages.jsonl", "--jobs", "2", "--results", "pages.jsonl.results", *OPTIONS.split()], place,
                     "pages.jsonl.results")


def by_parallel(place):
    run_killed_twice([os.path.join(RECIPES, "run-parallel"), "pages.jsonl", "2"], place, "pages.jsonl.results")


def by_snakemake(place):
    words = ["snakemake", "--snakefile", os.path.join(RECIPES, "Snakefile"), "--config", "manifest=pages.jsonl", "batten=" + CLI,
             "--cores", "2", "--keep-going", "--retries", "1", "--rerun-incomplete", "--quiet"]

    def unlock(place):
        start(words + ["--unlock"], place).wait()

    run_killed_twice(words, place, "pages.jsonl.results", unlock)


def make_report(place):
    words = ["snakemake", "report", "--snakefile", os.path.join(RECIPES, "Snakefile"), "--config", "manifest=pages.jsonl",
             "batten=" + CLI, "--cores", "2", "--quiet"]
    if start(words, place).wait() != 0:
        with open(os.path.join(place, "log")) as file:
            fail("snakemake, report: " + file.read()[-2000:])


class Slurm:
    """A controller and a node of our own on loopback, with accounts of neither; ended with this object."""

    def __init__(self, place):
        self.place = os.path.join(place, "slurm")
        os.makedirs(self.place)
        self.processes = []
        host = socket.gethostname().split(".")[0]
        munge = os.path.join(self.place, "munge")
        os.makedirs(munge, mode=0o700)
        key = os.path.join(munge, "key")
        with open(key, "wb") as out:
            out.write(os.urandom(128))
        os.chmod(key, 0o400)
        self.socket = os.path.join(munge, "socket")
        os.chmod(munge, 0o755)
        self.run(["munged", "--foreground", "--force", "--socket=" + self.socket, "--key-file=" + key,
                  "--log-file=" + os.path.join(munge, "log"), "--pid-file=" + os.path.join(munge, "pid"),
                  "--seed-file=" + os.path.join(munge, "seed")])
        self.config = os.path.join(self.place, "slurm.conf")
        with open(self.config, "w") as out:
            out.write("""ClusterName=batten
SlurmctldHost=%(host)s(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=%(socket)s
CryptoType=crypto/munge
SlurmctldPort=16817
SlurmdPort=16818
StateSaveLocation=%(place)s/state
SlurmdSpoolDir=%(place)s/spool
SlurmctldPidFile=%(place)s/ctld.pid
SlurmdPidFile=%(place)s/d.pid
SlurmctldLogFile=%(place)s/ctld.log
SlurmdLogFile=%(place)s/d.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
MpiDefault=none
SwitchType=switch/none
NodeName=%(host)s NodeAddr=127.0.0.1 CPUs=%(cpus)d State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""" % {"host": host, "socket": self.socket, "place": self.place, "cpus": os.cpu_count()})
        os.makedirs(os.path.join(self.place, "state"))
        os.makedirs(os.path.join(self.place, "spool"))
        time.sleep(1)
        self.run(["slurmctld", "-D", "-f", self.config])
        self.run(["slurmd", "-D", "-f", self.config, "-N", host])
        self.environment = dict(os.environ, SLURM_CONF=self.config, BATTEN_OPTIONS=OPTIONS)

    def run(self, words):
        log = open(os.path.join(self.place, words[0] + ".out"), "wb")
        self.processes.append(subprocess.Popen(words, stdout=log, stderr=log, stdin=subprocess.DEVNULL,
                                               env=dict(os.environ, SLURM_CONF=getattr(self, "config", ""))))

    def ask(self, *words):
        return subprocess.run(words, env=self.environment, capture_output=True, text=True)

    def is_running(self):
        """Whether the daemons that were started are all still there."""
        return all(p.poll() is None for p in self.processes)

    def is_up(self):
        for _ in range(100):
            if "idle" in self.ask("sinfo", "-h", "-o", "%T").stdout:
                return True
            if any(p.poll() is not None for p in self.processes):
                return False
            time.sleep(0.3)
        return False

    def end(self):
        for process in reversed(self.processes):
            process.terminate()
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()


def by_slurm(place):
    slurm = Slurm(place)
    try:
        if not slurm.is_up():
            return "Slurm cannot start here: " + slurm.ask("sinfo").stderr.strip()
        lines = max(1, count // 20)
        words = ["sbatch", "--parsable", "--array=0-%d" % ((count - 1) // lines), "--chdir=" + place,
                 os.path.join(RECIPES, "slurm-array"), "pages.jsonl", str(lines)]
        kills = 0
        for share in (0.3, 0.6, None):
            submitted = slurm.ask(*words)
            if submitted.returncode != 0:
                if slurm.is_running():
                    fail("slurm runs and refuses the array: " + submitted.stderr.strip())
                return "Slurm takes no job: " + submitted.stderr.strip()
            job = submitted.stdout.strip()
            while slurm.ask("squeue", "-h", "-j", job).stdout.strip():
                if share and len(results_of(place, "pages.jsonl.results")) >= share * count:
                    kills += slurm.ask("scancel", "--signal=KILL", "--full", job).returncode == 0
                    slurm.ask("scancel", job)
                    while slurm.ask("squeue", "-h", "-j", job).stdout.strip():
                        time.sleep(0.1)
                    break
                time.sleep(0.1)
        if kills != 2:
            fail("slurm ended before it was killed twice")
        return None
    finally:
        slurm.end()


class MemoryGroup:
    """A control group that holds at most so many bytes; `why` says why there is none."""

    def __init__(self, limit):
        self.why, self.folder = None, None
        for root, name in (("/sys/fs/cgroup/memory", "memory.limit_in_bytes"), ("/sys/fs/cgroup", "memory.max")):
            if not os.path.exists(os.path.join(root, "cgroup.procs")):
                continue
            folder = os.path.join(root, "batten-test-%d" % os.getpid())
            try:
                os.mkdir(folder)
                self.folder = folder
                with open(os.path.join(folder, name), "w") as out:
                    out.write(str(limit))
                return
            except OSError as error:
                self.why = str(error)
        self.why = self.why or "no hierarchy of control groups"

    def enter(self):
        with open(os.path.join(self.folder, "cgroup.procs"), "w") as out:
            out.write(str(os.getpid()))

    def end(self):
        if self.folder:
            os.rmdir(self.folder)


def most_at_once(place, jobs, **more):
    """How many pages a batch has had running at once."""
    process = start([CLI, "batch", "pages.jsonl", "--jobs", str(jobs), "--results", "pages.jsonl.results", *OPTIONS.split()], place, **more)
    most = 0
    while process.poll() is None:
        try:
            with open("/proc/%d/task/%d/children" % (process.pid, process.pid)) as file:
                most = max(most, len(file.read().split()))
        except OSError:
            pass
        time.sleep(0.02)
    return most


def by_little_memory(source, single, told):
    """Six jobs where memory holds the batch and no more than two or three pages beside it: none is started for which there is none."""
    free = copy_of(source, "memory-free")
    unlimited = most_at_once(free, 6)
    group = MemoryGroup(160 << 20)
    try:
        if group.why:
            print("memory: passed over. No control group can be made: " + group.why)
            return
        place = copy_of(source, "memory")
        most = most_at_once(place, 6, preexec_fn=group.enter)
        # The largest page fails here for want of memory, and alone because it takes too long.
        largest = "scans/p%04d.pgm" % (len(told) // 2)
        refused = {one["scan"]: one for one in results_of(place, "pages.jsonl.results")}[largest]
        if "of memory" not in refused.get("error", ""):
            fail("memory: the largest page is %s (%s)" % (refused["status"], refused.get("error")))
        check("memory", place, single, {**told, largest: (refused["status"], refused.get("error"))})
    finally:
        group.end()
    print("6 jobs: %d pages at once; where 160 MB are allowed: %d" % (unlimited, most))
    if unlimited != 6 or most > 3:
        fail("memory: %d pages at once, of 6 jobs" % most)


def check(way, place, reference, told):
    lines = results_of(place, "pages.jsonl.results")
    finished = collections.Counter(one["scan"] for one in lines if one["status"] != "failed")
    last = {one["scan"]: one for one in lines}
    if set(last) != set(told):
        fail("%s: not every page is told of: %s" % (way, sorted(set(told) ^ set(last))[:5]))
    for scan, times in finished.items():
        if times != 1:
            fail("%s: %s is told of %d times" % (way, scan, times))
    numbers = {page["scan"]: number for number, page in enumerate(pages_of(place), 1)}
    for scan, one in last.items():
        if one["line"] != numbers[scan]:
            fail("%s: %s is told to be line %d of the manifest, and is line %d" % (way, scan, one["line"], numbers[scan]))
    for page in pages_of(place):
        scan = page["scan"]
        status, error = told[scan]
        now = "done" if last[scan]["status"] == "unchanged" and status == "done" else last[scan]["status"]
        now = "empty" if now == "unchanged" and status == "empty" else now
        if now != status or (status != "done" and last[scan].get("error") != error):
            fail("%s: %s is %s (%s), alone it is %s (%s)" % (way, scan, now, last[scan].get("error"), status, error))
        for output in page["outputs"]:
            a, b = os.path.join(reference, output), os.path.join(place, output)
            if status == "done" and open(a, "rb").read() != open(b, "rb").read():
                fail("%s: %s differs from that of a single call" % (way, output))
            if status != "done" and os.path.exists(b):
                fail("%s: %s is there, but the page is %s" % (way, output, status))
    known = {name for page in pages_of(place) for output in page["outputs"] for name in (output, page["outputs"][0] + ".batch.json")}
    stray = [name for name in os.listdir(os.path.join(place, "curves")) if os.path.join("curves", name) not in known]
    if stray:
        fail("%s: stray files: %s" % (way, stray[:5]))


def check_report(way, place, manifest, told):
    """The report of a workflow is a page in HTML that names every scan of the manifest and stays as it is on another run."""
    path = os.path.join(place, manifest + ".report.html")
    if not os.path.exists(path):
        fail("%s: there is no report" % way)
    with open(path, encoding="utf-8") as file:
        text = file.read()
    missing = [page["scan"] for page in pages_of(place) if os.path.basename(page["scan"]) not in text]
    if missing:
        fail("%s: the report does not name %s" % (way, missing[:5]))
    failed = [scan for scan, (status, _) in told.items() if status == "failed"]
    print("%s: the report names all %d pages, %d of them failed, in %d kB" % (way, len(told), len(failed), len(text) // 1000))
    if "http://" in text or "https://" in text:
        fail("%s: the report fetches something from the network" % way)


def cost_of_sample():
    """Prints what the sample costs by itself: the figures of the help page on many drawings."""
    samples = os.path.join(os.path.dirname(os.path.abspath(CLI)), "..", "share", "batten", "samples")
    if not os.path.exists(os.path.join(samples, "coupe-side.png")):
        print("the sample is not beside the program (target sample_sketch): its cost is not measured")
        return
    lines, sizes = [], {}
    for number in range(3):
        place = os.path.join(folder, "sample%d" % number)
        done = subprocess.run([CLI, "batch", samples, "--to", place], capture_output=True, text=True)
        if done.returncode != 0:
            fail("the sample: " + done.stderr)
        lines.append(done.stdout)
        sizes = {name: os.path.getsize(os.path.join(place, name)) for name in os.listdir(place)}
    told = [json.loads(line) for line in lines]
    outputs = sum(size for name, size in sizes.items() if not name.endswith(".batch.json"))
    print("the sample: %s CPU s, %.0f MB of memory, %.1f kB of SVG and JSON, %.1f kB of record, %.1f kB in the results" %
          (" ".join("%.1f" % (one["processor_milliseconds"] / 1e3) for one in told),
           max(one["peak_memory_bytes"] for one in told) / 1e6, outputs / 1e3, (sum(sizes.values()) - outputs) / 1e3,
           len(lines[0]) / 1e3), flush=True)


def copy_of(source, name):
    place = os.path.join(folder, name)
    shutil.copytree(source, place, copy_function=os.link)  # the scans; nothing writes to them
    return place


ROW = "%-30s %8s %10s %8s %10s %8s"


def show(name, seconds, processor=None, peak=None):
    print(ROW % (name, "%.1f" % seconds, "%.1f" % (60 * count / seconds), "" if processor is None else "%.1f" % processor,
                 "" if processor is None else "%.3f" % (processor / count), "-" if peak is None else "%.0f" % peak), flush=True)


def small_archive(name, pages):
    """The first pages that can be traced, in a folder with a blank, a quote and braces in its manifest's name."""
    place = os.path.join(folder, name)
    os.makedirs(os.path.join(place, "scans"))
    os.makedirs(os.path.join(place, "curves"))
    source = os.path.join(folder, "source")
    chosen = [page for i, page in enumerate(pages_of(source)) if i < 7 and i not in (count // 2, count // 3)][:pages]
    lines = []
    for page in chosen:
        shutil.copy(os.path.join(source, page["scan"]), os.path.join(place, page["scan"]))
        page["outputs"] = [name.replace("p0", "p {a} 0") for name in page["outputs"]]
        lines.append(json.dumps(page))
    manifest = "it's {} my list.jsonl"
    with open(os.path.join(place, manifest), "w") as out:
        out.write(lines[0] + "\n\n" + "\n".join(lines[1:]))  # a blank line, and none behind the last
    return place, manifest, chosen


def runs_again(name, command):
    """A way run again after a scan was changed, a line was put in and outputs were removed makes just that anew."""
    place, manifest, pages = small_archive(name + "-again", 4)
    path = os.path.join(place, manifest)

    def run():
        process = start(command(manifest), place)
        if process.wait() != 0:
            with open(os.path.join(place, "log")) as file:
                fail("%s, %s: ended with %d: %s" % (name, manifest, process.returncode, file.read()[-2000:]))

    def made():
        return {page["scan"]: tuple(os.stat(os.path.join(place, one)).st_mtime_ns for one in page["outputs"]) for page in pages}

    run()
    first = made()
    run()
    if made() != first:
        fail("%s: run again, pages are made anew though nothing has changed" % name)
    changed, removed = pages[1], pages[2]
    time.sleep(1.1)  # some file systems know whole seconds only
    shutil.copy(os.path.join(place, pages[3]["scan"]), os.path.join(place, changed["scan"]))
    os.utime(os.path.join(place, changed["scan"]))
    os.remove(os.path.join(place, removed["outputs"][1]))
    added = dict(pages[0], outputs=["curves/added.svg"])
    with open(path) as file:
        text = file.read()
    with open(path, "w") as out:
        out.write(json.dumps(added) + "\n" + text)
    run()
    if not os.path.exists(os.path.join(place, "curves/added.svg")):
        fail("%s: a line that was put in is left undone" % name)
    now = made()
    for page in pages:
        if (now[page["scan"]] != first[page["scan"]]) != (page in (changed, removed)):
            fail("%s: run again, %s is %s" % (name, page["scan"], "left" if page in (changed, removed) else "made anew"))
    told = collections.Counter(one["key"] for one in results_of(place, manifest + ".results"))
    again = [key for key, times in told.items() if times > 1]
    if again:
        fail("%s: pages are told of twice: %s" % (name, told))
    print("%s, run again: what has changed, and nothing else, is made anew" % name, flush=True)


def judge_speed(times, others):
    """Holds the speed of two jobs against what is asked. What else runs takes from it, so only a quiet machine can fail."""
    quiet = PROCESSORS >= 2 and others <= 0.1
    reached = times >= 1.8
    print("  2 jobs, >= 1.8 x asked: %s, %.2f x; other programs kept %.1f of %d processors busy: %s" %
          ("reached" if reached else "not reached", times, others, PROCESSORS,
           "a quiet machine" if quiet else "not a quiet machine, so that this proves nothing"))
    if quiet and not reached:
        fail("two jobs are %.2f times as fast as single calls on a quiet machine; 1.8 were expected" % times)


def main():
    source = os.path.join(folder, "source")
    subprocess.run([sys.executable, os.path.join(HERE, "make_pages.py"), source, str(count)], check=True)
    single = copy_of(source, "single")
    others = OtherWork()
    begin, before = time.time(), processor_seconds()
    told, peak = single_calls(single)
    alone, work = time.time() - begin, processor_seconds() - before
    kinds = collections.Counter(status for status, _ in told.values())
    print("%d pages: %s; the page that takes too long is ended after %g s" %
          (count, ", ".join("%d %s" % (n, kind) for kind, n in sorted(kinds.items())), TIMEOUT))
    if dict(kinds) != {kind: n for kind, n in expected_kinds().items() if n}:
        fail("single calls: expected were %s" % expected_kinds())
    written = [os.path.getsize(os.path.join(single, name)) for page in pages_of(single) for name in page["outputs"]
               if os.path.exists(os.path.join(single, name))]
    print("outputs: %.0f kB for each page that is done" % (sum(written) / kinds["done"] / 1e3))
    print("peak MB: the largest process of all, pages ended for time included; - where kill -9 takes the figure along")
    print("threads a page: %d in the loop and with 2 at once, %d with 1 at once, on %d processors" % (THREADS, PROCESSORS, PROCESSORS))
    print(ROW % ("", "seconds", "pages/min", "CPU s", "CPU s/page", "peak MB"))
    show("single calls in a loop", alone, work, peak)
    for jobs in (1, 2):
        place = copy_of(source, "jobs%d" % jobs)
        begin, before = time.time(), processor_seconds()
        peak = wait_for(start([CLI, "batch", "pages.jsonl", "--jobs", str(jobs), "--results", "pages.jsonl.results",
                               *OPTIONS.split()], place))
        seconds, work = time.time() - begin, processor_seconds() - before
        check("batch", place, single, told)
        show("batch, %d at once (%.2f x)" % (jobs, alone / seconds), seconds, work, peak)
        if jobs == 2:
            judge_speed(alone / seconds, others.processors())
    for name, way in (("batch", by_batch), ("parallel", by_parallel), ("slurm", by_slurm), ("snakemake", by_snakemake)):
        if WAYS and name not in WAYS:
            continue
        place = copy_of(source, name + "-killed")
        begin = time.time()
        why = way(place)
        seconds = time.time() - begin
        if why:
            print("%s: passed over. %s" % (name, why), flush=True)
            continue
        check(name, place, single, told)
        show(name + ", killed by -9 twice", seconds)
        if name == "snakemake":
            make_report(place)
            check_report(name, place, "pages.jsonl", told)
            check(name, place, single, told)
    if not WAYS or "parallel" in WAYS:
        runs_again("parallel", lambda manifest: [os.path.join(RECIPES, "run-parallel"), manifest, "2"])
    if not WAYS or "snakemake" in WAYS:
        runs_again("snakemake", lambda manifest: ["snakemake", "--snakefile", os.path.join(RECIPES, "Snakefile"), "--config",
                                                  "manifest=" + manifest, "batten=" + CLI, "--cores", "2", "--quiet"])
    cost_of_sample()
    if not WAYS or "memory" in WAYS:
        by_little_memory(source, single, told)
    print("load of the machine meanwhile: %.1f on %d processors" % (os.getloadavg()[2], os.cpu_count()))


main()
