#!/usr/bin/env python3
"""Measures Pelage beside plain programs and writes the tables of docs/performance.md.

    python3 bench/tables.py                      all tables; about ten minutes on two quiet cores
    python3 bench/tables.py --only growth,error  some of them
    python3 bench/tables.py --only ''            none: the page anew from bench/results
    python3 bench/tables.py --baseline OLD       a second column with the seconds of another pelage, run in turns

A time is the median of three runs, or the only one of a run longer than five seconds.
"""
import argparse, json, math, os, pathlib, platform, re, shlex, statistics, subprocess, sys, tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
LONG = 5  # seconds: such a run is not repeated


class Failed(Exception):
    """A command that did not succeed; its last line of stderr."""


class Bench:
    """Runs programs in one folder of passing files. Commands name no other folder."""

    def __init__(self, options, folder):
        self.options, self.folder, self.quick = options, folder, options.quick

    def run(self, program, arguments, path=None):
        """The JSON that the program prints, with "bytes", its peak memory."""
        path = path or self.options.bin / program
        process = subprocess.Popen([path, *arguments], cwd=self.folder, text=True, stdout=subprocess.PIPE,
                                   stderr=open(self.folder / "stderr", "w"))
        out = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            lines = (self.folder / "stderr").read_text().strip().splitlines()
            raise Failed(lines[-1] if lines else f"exit code {process.returncode}")
        result = json.loads(out)
        result["bytes"] = usage.ru_maxrss * 1024
        return result

    def row(self, what, program, command, key="growth_seconds", show=(), **more):
        """One row: the run whose `key` is the median, what measure says of its output grown.ply if `show` names
        species, and the seconds of the baseline, which runs in turns with it."""
        command = " ".join(command.split())
        arguments = shlex.split(command)
        row = {"what": what, "command": f"{program} {command}", **more}
        print(f"{what}: {row['command']}", file=sys.stderr, flush=True)
        runs, before = [], []
        baseline = self.options.baseline if program == "pelage" else None
        try:
            while len(runs) < self.options.runs and (not runs or runs[0]["seconds"] < LONG):
                if baseline and before is not None:
                    try:
                        before.append(self.run(program, arguments, baseline)[key])
                    except Failed:
                        before = None  # it knows no such options
                runs.append(self.run(program, arguments))
            if show:
                row.update(self.measure(*show))
        except Failed as failure:
            return {**row, "failed": str(failure)}
        run = sorted(runs, key=lambda r: r[key])[len(runs) // 2]
        growths = [s["growth"] for s in run.get("stages", [])] or [run]
        row.update(seconds=run[key], whole=run["seconds"], bytes=run["bytes"], json=run,
                   vertices=run.get("control_vertices", run.get("vertices")), steps=sum(g["steps"] for g in growths))
        if before:
            row["baseline_seconds"] = statistics.median(before)
        return row

    def measure(self, species, against=None):
        m = self.run("measure", ["grown.ply", "--species", species] + (["--against", against] if against else []))
        return {k: m[k] for k in ("spots", "wavelength", "error") if k in m}


# --- the tables: each gives its rows ------------------------------------------------------------------------------

SPECIES = {"schnakenberg": "v,u", "turing:production": "a,b"}
OUTPUT = "--detail 0 --json -q -o grown.ply"
PLAIN = {"Euler": "--method euler", "RKC2": "--method rkc2", "SBDF2": "--method sbdf2 --real double"}


def sphere(n, edges=10):
    """The built-in sphere, and a size of so many of its edges."""
    return f"builtin:sphere?n={n}", edges * math.sqrt(4 * math.pi / n * 2 / math.sqrt(3))


def length_unit(bench, shape, model, size):
    run = bench.run("pelage", shlex.split(f"grow '{shape}' --model {model} --size {size:.5g}u --steps 1 {OUTPUT}"))
    return run["stages"][0]["length_unit"]


def growth(bench):
    """From the random start to rest, or to the model's end."""
    for model, species in SPECIES.items():
        for n in [642] if bench.quick else [10242, 40962, 163842]:
            shape, size = sphere(n)
            unit = length_unit(bench, shape, model, size)
            ours = f"grow '{shape}' --model {model} --size {size:.5g}u"
            theirs = f"'{shape}' --model {model} --unit {unit:.9g}"
            programs = [("default", "pelage", f"{ours} {OUTPUT}"), ("Loop", "pelage", f"{ours} --method loop {OUTPUT}")]
            programs += [(f"plain {k}", "plain", f"{theirs} {v} -o grown.ply") for k, v in PLAIN.items()]
            for what, program, command in programs:
                row = bench.row(what, program, command, show=[species], case=f"{model}, {n}")
                if "wavelength" in row:
                    row["wavelength"] /= size
                yield row


def with_resolution(bench, resolution):
    """A copy of Schnakenberg's model that asks for so many vertices per wavelength."""
    text = (ROOT / "models/schnakenberg.toml").read_text()
    name = f"schnakenberg-{resolution}.toml"
    (bench.folder / name).write_text(text.replace("[suggested]", f"[suggested]\nresolution = {resolution}"))
    return name


def error(bench):
    """A run of fixed length on one smooth surface, against the same with far smaller elements and steps."""
    until, fine, step = (4, 6, 0.1) if bench.quick else (20, 15, 0.02)
    shape, size = "'builtin:sphere?n=642'", 0.33
    stop = f"--size {size}u --until {until} --stationary 0"
    reference = f"grow {shape} --model {with_resolution(bench, fine)} {stop} --method loop --step {step}"
    yield bench.row("reference", "pelage", f"{reference} --detail 0 --json -q -o reference.ply")

    def row(what, program, command):
        return bench.row(what, program, command, show=["v,u", "reference.ply"])
    for quality in "draft", "normal", "fine":
        yield row(f"default, {quality}", "pelage", f"grow {shape} --model schnakenberg {stop} --quality {quality} {OUTPUT}")
    loops = {6: [""]} if bench.quick else {6: ["", "--step 0.1", "--step 0.05"]}
    for resolution, steps in loops.items():
        for s in steps:
            model = with_resolution(bench, resolution)
            yield row("Loop", "pelage", f"grow {shape} --model {model} {stop} --method loop {s} {OUTPUT}")
    unit = length_unit(bench, shape.strip("'"), "schnakenberg", size)
    for level in [1] if bench.quick else [2, 3, 4]:
        mesh = f"limit-{level}.ply"  # vertices on the smooth surface
        bench.run("pelage", shlex.split(f"grow {shape} --method loop --size 1u --steps 1 --detail {level} --json -q -o {mesh}"))
        for name, method in PLAIN.items():
            for s in [""] if name == "Euler" else ["--step 0.2", "--step 0.1", "--step 0.05"][level // 4:]:
                options = f"--unit {unit:.9g} {method} {s} --until {until} --stationary 0"
                yield row(f"plain {name}", "plain", f"{mesh} {options} -o grown.ply")


def commands(bench):
    """Whole commands as a user gives them, files and pictures included."""
    size = "--size 0.2 --steps 5 --picture-size 64" if bench.quick else ""
    yield bench.row("make demo", "pelage", f"grow --recipe demo -o demo.glb,demo.ply --picture demo.png {size} --json -q",
                    key="seconds")
    names = sorted(p.stem for p in (ROOT / "recipes").glob("*.toml"))
    for name in ["demo"] if bench.quick else names:
        size = "--size 0.2 --steps 5" if bench.quick else ""
        yield bench.row(name, "pelage", f"grow builtin:animal --recipe {name} -o coat.glb {size} --json -q", key="seconds")


def scaling(bench):
    """Twenty steps at growing sizes, on one thread and on two; memory less that of a run of hardly any vertices."""
    def programs(n, threads):
        shape, size = sphere(n)
        common = f"--step 0.1 --steps 20 --threads {threads}"
        ours = f"grow '{shape}' --model schnakenberg --size {size:.5g}u {common}"
        yield "default", "pelage", f"{ours} {OUTPUT}"
        yield "Loop", "pelage", f"{ours} --method loop {OUTPUT}"
        yield "plain RKC2", "plain", f"'{shape}' --unit {size / 12.8:.9g} --method rkc2 {common} -o grown.ply"
    least = {what: bench.row(what, *command) for what, *command in programs(162, 1)}
    for n in [642] if bench.quick else [40962, 163842, 655362]:
        for threads in 1, 2:
            for what, *command in programs(n, threads):
                row = bench.row(what, *command, threads=threads)
                if "failed" not in row:
                    row["per_step"] = row["seconds"] / row["steps"] / row["vertices"]
                    row["per_vertex"] = (row["bytes"] - least[what].get("bytes", 0)) / row["vertices"]
                yield row


def kernels(bench):
    """How much of the bandwidth a pass over the matrix uses; where the seconds of a run went."""
    shape, size = sphere(2562 if bench.quick else 163842)
    for threads in 1, 2:
        for name in "Euler", "RKC2":
            command = f"'{shape}' --unit {size / 12.8:.9g} {PLAIN[name]} --steps 50 --threads {threads} --triad"
            row = bench.row(f"plain {name}", "plain", command, threads=threads)
            run = row.get("json", {})
            yield {**row, "speed": run.get("bytes_per_second"), "triad": run.get("triad_bytes_per_second")}
        command = f"grow '{shape}' --model schnakenberg --size {size:.5g}u --steps 50 --step 0.1 --threads {threads} --profile"
        row = bench.row("default", "pelage", f"{command} {OUTPUT}", threads=threads)
        profile = row.get("json", {}).get("profile", {})
        # The two rates are there when the program reports them.
        yield {**row, "speed": profile.get("kernel_bytes_per_second"), "triad": profile.get("triad_bytes_per_second"),
               "phases": profile.get("seconds")}


TABLES = {t.__name__: t for t in (growth, error, commands, scaling, kernels)}

# --- the page -----------------------------------------------------------------------------------------------------

def digits(x, n=3):
    """So many significant digits, without an exponent."""
    if not x:
        return "0"
    places = max(0, n - 1 - math.floor(math.log10(abs(x))))
    return f"{x:.{places}f}"


SECONDS = [("growth, s", lambda r: digits(r["seconds"])), ("baseline, s", lambda r: digits(r["baseline_seconds"])),
           ("whole, s", lambda r: digits(r["whole"]))]
COMMAND = ("command", lambda r: f"`{r['command']}`")
VERTICES = ("vertices", lambda r: r["vertices"])
STEPS = ("steps", lambda r: r["steps"])
COLUMNS = {
    "growth": [("run", lambda r: r["case"]), ("program", lambda r: r["what"]), VERTICES, STEPS, *SECONDS,
               ("spots", lambda r: r["spots"]), ("wavelength / size", lambda r: digits(r["wavelength"])), COMMAND],
    "error": [("program", lambda r: r["what"]), VERTICES, STEPS, *SECONDS[:2],
              ("error, %", lambda r: digits(100 * r["error"], 2)), COMMAND],
    "commands": [("what", lambda r: r["what"]), VERTICES, STEPS,
                 ("growth, s", lambda r: digits(r["json"]["growth_seconds"])), ("whole, s", lambda r: digits(r["seconds"])),
                 ("baseline, s", lambda r: digits(r["baseline_seconds"])), COMMAND],
    "scaling": [("program", lambda r: r["what"]), ("threads", lambda r: r["threads"]), VERTICES, *SECONDS[:2],
                ("ns per vertex and step", lambda r: digits(1e9 * r["per_step"])),
                ("bytes per vertex", lambda r: f"{r['per_vertex']:.0f}"), COMMAND],
    "kernels": [("program", lambda r: r["what"]), ("threads", lambda r: r["threads"]), *SECONDS[:1],
                ("GB/s", lambda r: digits(r["speed"] / 1e9)), ("triad, GB/s", lambda r: digits(r["triad"] / 1e9)),
                ("share, %", lambda r: f"{100 * r['speed'] / r['triad']:.0f}"),
                ("seconds of", lambda r: ", ".join(f"{k} {digits(v, 2)}" for k, v in r["phases"].items())), COMMAND],
}


def cell(show, row):
    try:
        return str(show(row))
    except (KeyError, TypeError):
        return ""


def markdown(columns, rows):
    """Without the columns that no row fills."""
    rows = [r for r in rows if "failed" not in r]
    columns = [(head, show) for head, show in columns if any(cell(show, r) for r in rows)]
    lines = [[head for head, _ in columns], ["---"] * len(columns)]
    lines += [[cell(show, r) for _, show in columns] for r in rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


COLOURS = {"default": "#c8501e", "Loop": "#1f5fa8", "plain Euler": "#8a8a8a", "plain RKC2": "#3d8f4f", "plain SBDF2": "#8e5bb5"}


def plot(rows):
    """Error against seconds, both logarithmic, as SVG."""
    points = [(r["what"].split(",")[0], r["seconds"], 100 * r["error"]) for r in rows if r.get("error")]
    if not points:
        return None
    width, height, left, top, right, bottom = 720, 460, 70, 20, 150, 50

    def axis(values, begin, end):
        low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
        high = max(high, low + 1)
        return (lambda v: begin + (end - begin) * (math.log10(v) - low) / (high - low)), range(low, high + 1)
    x, x_decades = axis([p[1] for p in points], left, width - right)
    y, y_decades = axis([p[2] for p in points], height - bottom, top)
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="13">',
           f'<rect width="{width}" height="{height}" fill="white"/>']

    def text(at_x, at_y, words, more=""):
        svg.append(f'<text x="{at_x:.1f}" y="{at_y:.1f}" {more}>{words}</text>')

    def line(x1, y1, x2, y2):
        svg.append(f'<path d="M{x1:.1f} {y1:.1f}L{x2:.1f} {y2:.1f}" stroke="#ddd"/>')
    for d in x_decades:
        line(x(10 ** d), top, x(10 ** d), height - bottom)
        text(x(10 ** d), height - bottom + 18, f"{10.0 ** d:g}", 'text-anchor="middle"')
    for d in y_decades:
        line(left, y(10 ** d), width - right, y(10 ** d))
        text(left - 8, y(10 ** d) + 4, f"{10.0 ** d:g}", 'text-anchor="end"')
    text((left + width - right) / 2, height - 10, "seconds of growth", 'text-anchor="middle"')
    text(18, height / 2, "error, %", f'text-anchor="middle" transform="rotate(-90 18 {height / 2})"')
    for k, (name, colour) in enumerate(COLOURS.items()):
        svg += [f'<circle cx="{x(s):.1f}" cy="{y(e):.1f}" r="5" fill="{colour}"/>' for n, s, e in points if n == name]
        svg.append(f'<circle cx="{width - right + 20}" cy="{top + 14 + 22 * k}" r="5" fill="{colour}"/>')
        text(width - right + 32, top + 18 + 22 * k, name)
    return "\n".join(svg + ["</svg>", ""])


def machine(results):
    """A line about the machine, from what the kernels measured."""
    rows = results.get("kernels", {"rows": []})["rows"]
    triads = {r["threads"]: r["triad"] for r in rows if r.get("triad")}
    m = results.get("kernels", {}).get("machine", {})
    speeds = ", ".join(f"{digits(v / 1e9)} GB/s on {k} thread{'s' * (k > 1)}" for k, v in sorted(triads.items()))
    return f"{m.get('cores')} cores of {m.get('processor')}, {m.get('cache')} of cache; triad of floats: {speeds}.\n" if m else ""


def this_machine():
    info = pathlib.Path("/proc/cpuinfo")
    words = dict(re.findall(r"^(model name|cache size)\s*:\s*(.*?)(?: Processor)?$", info.read_text(), re.M)) if info.exists() else {}
    last = sorted(pathlib.Path("/sys/devices/system/cpu/cpu0/cache").glob("index*/size"))
    return {"cores": os.cpu_count(), "processor": words.get("model name", platform.machine()),
            "cache": last[-1].read_text().strip().replace("K", " KiB") if last else words.get("cache size", "unknown size")}


def write_page(path, results):
    page = path.read_text()
    blocks = {name: markdown(COLUMNS[name], results[name]["rows"]) for name in TABLES if name in results}
    blocks["machine"] = machine(results)
    for name, block in blocks.items():
        page, count = re.subn(rf"(<!-- table: {name} -->\n).*?(<!-- end -->)", lambda m: m[1] + block + m[2], page, flags=re.S)
        if count != 1:
            sys.exit(f"tables: {path} has {count} places for the table {name}; it needs one")
    path.write_text(page)
    if svg := plot(results.get("error", {"rows": []})["rows"]):
        (path.parent / "performance-error.svg").write_text(svg)


# --- the command --------------------------------------------------------------------------------------------------

def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin", help="folder of pelage, plain and measure")
    parser.add_argument("--baseline", type=pathlib.Path, help="another pelage")
    parser.add_argument("--runs", type=int, help="of each short command; default: 3")
    parser.add_argument("--quick", action="store_true", help="tiny runs: only whether it works")
    parser.add_argument("--only", help="some of " + ",".join(TABLES))
    parser.add_argument("--results", type=pathlib.Path, default=ROOT / "bench/results")
    parser.add_argument("--page", type=pathlib.Path, default=ROOT / "docs/performance.md")
    o = parser.parse_args()
    o.runs = o.runs or (1 if o.quick else 3)
    o.bin = o.bin.resolve()
    o.baseline = o.baseline and o.baseline.resolve()
    o.only = list(TABLES) if o.only is None else [n for n in o.only.split(",") if n]
    for name in o.only:
        if name not in TABLES:
            parser.error(f"no table {name}; there are {', '.join(TABLES)}")
    return o


def main():
    options = arguments()
    options.results.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(options, pathlib.Path(folder))
        for name in options.only:
            table = {"machine": this_machine(), "rows": list(TABLES[name](bench))}
            (options.results / f"{name}.json").write_text(json.dumps(table, indent=1) + "\n")
            for row in table["rows"]:
                if "failed" in row:
                    print(f"tables: failed: {row['command']}: {row['failed']}", file=sys.stderr)
    files = {name: options.results / f"{name}.json" for name in TABLES}
    write_page(options.page, {name: json.loads(f.read_text()) for name, f in files.items() if f.exists()})


if __name__ == "__main__":
    main()
