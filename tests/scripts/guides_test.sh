#!/usr/bin/env bash
# The guides can be followed: every command in them runs, in an empty folder and in their order; those of a block "sh fails"
# fail, as people would find them to; a block "text" stands in what the block before it printed; links lead somewhere. Only
# pictures are made smaller. Usage: SOURCE BINARY
set -uo pipefail
source=$1
[ -x "$2/bin/pelage" ] || { echo "no $2/bin/pelage: the program is not part of this build"; exit 77; }
work=$2/guides_test
rm -rf "$work" && mkdir -p "$work/bin" || exit 1
cat >"$work/bin/pelage" <<PROGRAM
#!/bin/sh
case "\$1 \$*" in
  "grow "*" --picture "* | "grow "*" --panels "*) exec "$2/bin/pelage" "\$@" --picture-size 64 ;;
  *) exec "$2/bin/pelage" "\$@" ;;
esac
PROGRAM
chmod +x "$work/bin/pelage"

PATH="$work/bin:$PATH" python3 - "$source" "$work" <<'PYTHON'
import os, pathlib, re, subprocess, sys, time
source, work = map(pathlib.Path, sys.argv[1:])
failures = []

def squeezed(text):
    return re.sub(r"\s+", " ", text)

def follow(guide):
    folder = work / guide.stem
    folder.mkdir()
    printed, commands = None, 0
    for kind, block in re.findall(r"^```(\w[\w ]*)\n(.*?)^```$", guide.read_text(), re.M | re.S):
        if kind == "text":
            for line in block.splitlines():
                if squeezed(line) not in squeezed(printed):
                    failures.append(f"{guide.name}: \"{line}\" is not what the commands before it print:\n{printed}")
        elif kind in ("sh", "sh fails"):
            run = subprocess.run(["bash", "-euo", "pipefail", "-c", block], cwd=folder, stdin=subprocess.DEVNULL,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            printed = run.stdout
            commands += 1
            if (run.returncode != 0) != (kind == "sh fails"):
                failures.append(f"{guide.name}: exit code {run.returncode} of\n{block}{printed}")
            for file in re.findall(r"^wrote +(\S+)", printed, re.M):
                if not (folder / file).stat().st_size:
                    failures.append(f"{guide.name}: {file} is empty")
        else:
            failures.append(f"{guide.name}: a block of the unknown kind \"{kind}\"")
    return commands

def anchors(page):
    headings = re.findall(r"^#+ (.*)$", page.read_text(), re.M)
    return {re.sub(r"[^\w\- ]", "", h.lower()).replace(" ", "-") for h in headings}

def check_links(page):
    for target in re.findall(r"\]\(([^)\s]+)\)", page.read_text()):
        if "://" in target:
            continue
        path, _, anchor = target.partition("#")
        to = page.parent / path if path else page
        if not to.exists():
            failures.append(f"{page.name}: no {target}")
        elif anchor and anchor not in anchors(to):
            failures.append(f"{page.name}: no heading for {target}")

guides = sorted((source / "docs" / "guides").glob("*.md"))
readme = (source / "README.md").read_text()
for guide in guides:
    start = time.monotonic()
    commands = follow(guide)
    print(f"{guide.name}: {commands} blocks in {time.monotonic() - start:.1f} s")
    if not commands:
        failures.append(f"{guide.name}: no commands were found")
    if f"docs/guides/{guide.name}" not in readme:
        failures.append(f"{guide.name}: README does not link it")
for page in [source / "README.md", *sorted((source / "docs").glob("**/*.md"))]:
    check_links(page)
if len(guides) < 7:
    failures.append("the guides were not found")
print("\n".join("FAILED: " + f for f in failures) or "all right")
sys.exit(bool(failures))
PYTHON
