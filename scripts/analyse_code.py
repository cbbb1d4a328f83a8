#!/usr/bin/env python3
"""Runs clang-tidy on several files at once, and not again on files that it found clean.

A file counts as clean as long as neither it, nor what it includes of the project, nor its compiler options, nor
.clang-tidy, nor the version of clang-tidy has changed. Headers of the system are not looked at: a plugin keeps
clang-tidy out of them.
"""
import argparse
import concurrent.futures
import hashlib
import json
import pathlib
import re
import shlex
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
INCLUDE = re.compile(rb'^\s*#\s*include\s*["<]([^">]+)[">]', re.MULTILINE)
PLUGIN = ROOT / "scripts" / "own_code_only.cpp"
FINDING = re.compile(r"^[^\s:]+:\d+:\d+: (?:warning|error): ")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True, help="folder of compile_commands.json")
    parser.add_argument("--jobs", type=int, default=1, help="how many files at once")
    parser.add_argument("files", nargs="*", type=pathlib.Path, help="sources to analyse; all without any")
    arguments = parser.parse_args()

    commands = read_commands(arguments.build.resolve(), [path.resolve() for path in arguments.files])
    keys = keys_of(commands, arguments.build.resolve())
    stamps = arguments.build / "analysed"
    stamps.mkdir(exist_ok=True)
    plugin = build_plugin(stamps)
    changed = [file for file in commands if not (stamps / keys[file]).exists()]
    print(f"{len(changed)} of {len(commands)} files to analyse", flush=True)

    said = set()
    unclean = 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        runs = {pool.submit(analyse, file, arguments.build, plugin): file for file in changed}
        for run in concurrent.futures.as_completed(runs):
            is_clean, findings = run.result()
            # Every source that includes a header finds the same in it.
            for finding in findings:
                if finding not in said:
                    print(finding, flush=True)
                said.add(finding)
            if is_clean:
                (stamps / keys[runs[run]]).touch()
            unclean += not is_clean
    sys.exit(f"{unclean} files are not clean" if unclean else 0)


def version_of_clang_tidy():
    return subprocess.run(["clang-tidy", "--version"], check=True, capture_output=True).stdout


def build_plugin(folder):
    """Compiles the plugin, unless it is there for this version of clang-tidy."""
    digest = hashlib.sha256(version_of_clang_tidy() + PLUGIN.read_bytes()).hexdigest()
    library = folder / f"own_code_only_{digest[:16]}.so"
    if not library.exists():
        run = subprocess.run(["llvm-config", "--cxxflags"], check=True, capture_output=True, text=True)
        flags = [*shlex.split(run.stdout), "-std=c++17", "-O1", "-fPIC", "-shared"]
        made = library.with_suffix(".part")
        subprocess.run(["c++", *flags, str(PLUGIN), "-o", str(made)], check=True)
        made.rename(library)
    return library


def read_commands(build, wanted):
    """Compiler command per source of the project."""
    with open(build / "compile_commands.json", encoding="utf-8") as file:
        entries = json.load(file)
    commands = {pathlib.Path(entry["file"]): entry["command"] for entry in entries}
    missing = [str(path) for path in wanted if path not in commands]
    if missing:
        sys.exit(f"not among the sources that are built: {' '.join(missing)}")
    return {path: commands[path] for path in sorted(wanted or commands)}


def keys_of(commands, build):
    """What the outcome for every source depends on, as a hash."""
    settings = version_of_clang_tidy() + PLUGIN.read_bytes()
    contents = {}

    def content(path):
        if path not in contents:
            contents[path] = path.read_bytes() if path.is_file() else None
        return contents[path]

    keys = {}
    for source, command in commands.items():
        folders = [pathlib.Path(word[2:]) for word in shlex.split(command) if word.startswith("-I")]
        folders = [folder for folder in folders if ROOT in [folder, *folder.parents] or build in folder.parents]
        seen = {source}
        waiting = [source]
        while waiting:
            file = waiting.pop()
            for name in INCLUDE.findall(content(file)):
                candidates = [(folder / name.decode()).resolve() for folder in [file.parent, *folders]]
                found = next((path for path in candidates if content(path) is not None), None)
                if found is not None and found not in seen:
                    seen.add(found)
                    waiting.append(found)
        digest = hashlib.sha256(settings + command.encode())
        for folder in source.parents:
            if ROOT in [folder, *folder.parents]:
                digest.update(b"\0" + (content(folder / ".clang-tidy") or b""))
        for file in sorted(seen):
            digest.update(b"\0" + str(file).encode() + b"\0" + content(file))
        keys[source] = digest.hexdigest()
    return keys


def analyse(source, build, plugin):
    """Whether a source is clean, and the findings, each with the lines that explain it."""
    command = ["clang-tidy", "-quiet", f"--load={plugin}", "-p", str(build), str(source)]
    run = subprocess.run(command, capture_output=True, text=True)
    findings = []
    for line in run.stdout.splitlines():
        if FINDING.match(line):
            findings.append(line)
        elif findings:
            findings[-1] += "\n" + line
    if run.returncode != 0 and not findings:
        reason = "\n".join(run.stderr.splitlines()[:3])
        findings = [f"{source}: clang-tidy ended with {run.returncode}\n{reason}"]
    return run.returncode == 0 and not findings, findings


if __name__ == "__main__":
    main()
