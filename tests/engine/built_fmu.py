"""FMUs for tests, built from C with the system's compiler: FMI 3.0 and 2.0, a lag, a spring and what can fail."""

from __future__ import annotations

import inspect
import os
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest

SOURCE = r"""
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
typedef struct { double u, current, x, f, time; } Unit;  /* mm, A, mm, kN, s */
static const double LAG = 0.02, STIFFNESS = 2.0;  /* s, kN/mm */
static double *place(Unit *one, unsigned reference) {
    double *places[] = {&one->u, &one->x, &one->f, &one->current};
    return reference < 4 ? places[reference] : 0;
}
static int step(Unit *one, double start, double h) {
    if (fabs(start - one->time) > 1e-9 || one->u > 40.0) return 3;  /* fmiError */
    double a = LAGGING ? exp(-h / LAG) : 0.0;
    one->x = a * one->x + (1.0 - a) * one->u;
    one->f = one->u < -40.0 ? NAN : STIFFNESS * one->x + one->current;
    one->time = start + h;
    return 0;
}
static int set(void *c, const unsigned *r, size_t n, const double *v) {
    for (size_t k = 0; k < n; k++) *place(c, r[k]) = v[k];
    return 0;
}
static int get(void *c, const unsigned *r, size_t n, double *v) {
    for (size_t k = 0; k < n; k++) v[k] = *place(c, r[k]);
    return 0;
}
#if FMI == 3
void *fmi3InstantiateCoSimulation() { return calloc(1, sizeof(Unit)); }
int fmi3SetFloat64(void *c, const unsigned *r, size_t n, const double *v, size_t m) { return set(c, r, n, v); }
int fmi3GetFloat64(void *c, const unsigned *r, size_t n, double *v, size_t m) { return get(c, r, n, v); }
int fmi3DoStep(void *c, double t, double h, bool p, bool *event, bool *end, bool *early, double *last) {
    *event = *end = *early = false;
    *last = t + h;
    return step(c, t, h);
}
void fmi3FreeInstance(void *c) { free(c); }
#else
void *fmi2Instantiate() { return calloc(1, sizeof(Unit)); }
int fmi2SetReal(void *c, const unsigned *r, size_t n, const double *v) { return set(c, r, n, v); }
int fmi2GetReal(void *c, const unsigned *r, size_t n, double *v) { return get(c, r, n, v); }
int fmi2DoStep(void *c, double t, double h, int p) { return step(c, t, h); }
void fmi2FreeInstance(void *c) { free(c); }
#endif
"""
UNITS = """<UnitDefinitions>
<Unit name="mm"><BaseUnit m="1" factor="0.001"/></Unit><Unit name="kN"><BaseUnit kg="1" m="1" s="-2" factor="1000"/></Unit>
</UnitDefinitions>"""
THIRD = f"""<?xml version="1.0"?>
<fmiModelDescription fmiVersion="3.0" modelName="rig" instantiationToken="rig">
<CoSimulation modelIdentifier="rig"/>{UNITS}
<ModelVariables>
<Float64 name="time" valueReference="9" causality="independent" variability="continuous"/>
<Float64 name="command" valueReference="0" causality="input" start="0" unit="mm"/>
<Float64 name="displacement" valueReference="1" causality="output" unit="mm"/>
<Float64 name="force" valueReference="2" causality="output" unit="kN"/>
<Float64 name="current" valueReference="3" causality="input" start="0"/>
</ModelVariables>
<ModelStructure><Output valueReference="1"/><Output valueReference="2"/></ModelStructure>
</fmiModelDescription>"""
SECOND = f"""<?xml version="1.0"?>
<fmiModelDescription fmiVersion="2.0" modelName="rig" guid="rig">
<CoSimulation modelIdentifier="rig"/>{UNITS}
<ModelVariables>
<ScalarVariable name="command" valueReference="0" causality="input"><Real start="0" unit="mm"/></ScalarVariable>
<ScalarVariable name="displacement" valueReference="1" causality="output"><Real unit="mm"/></ScalarVariable>
<ScalarVariable name="force" valueReference="2" causality="output"><Real unit="kN"/></ScalarVariable>
<ScalarVariable name="current" valueReference="3" causality="input"><Real start="0"/></ScalarVariable>
</ModelVariables>
<ModelStructure><Outputs><Unknown index="2"/><Unknown index="3"/></Outputs></ModelStructure>
</fmiModelDescription>"""


def build(folder: Path, fmi: int, lagging: bool = True) -> Path:
    """The FMU of a rig: a lag of 20 ms, or none, before a spring of 2 kN/mm. Its step fails above 40 mm; below -40 mm, NaN."""
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None:
        reason = "there is no C compiler, so no FMU is built (on Debian: apt-get install gcc libc6-dev)"
        (pytest.fail if os.environ.get("CI") == "true" else pytest.skip)(reason)
    fmpy = pytest.importorskip("fmpy", reason="FMPy is not installed: pip install -e '.[fmi]'")
    module = __import__(f"fmpy.fmi{fmi}", fromlist=["x"])
    kind = module.FMU3Slave if fmi == 3 else module.FMU2Slave
    names = [name for name, _ in inspect.getmembers(kind) if name.startswith(f"fmi{fmi}")]
    others = "\n".join(
        f"int {name}() {{ return 0; }}" for name in names if f" *{name}(" not in SOURCE and f" {name}(" not in SOURCE
    )
    source, library = folder / "rig.c", folder / "rig.so"
    source.write_text(f"#define FMI {fmi}\n#define LAGGING {int(lagging)}\n{SOURCE}\n{others}\n")
    subprocess.run([compiler, "-shared", "-fPIC", "-O1", "-w", "-o", library, source, "-lm"], check=True)
    path = folder / f"rig{fmi}{'' if lagging else '-direct'}.fmu"
    place = f"binaries/{fmpy.platform_tuple if fmi == 3 else fmpy.platform}/rig.so"
    with zipfile.ZipFile(path, "w") as archive:
        archive.write(library, place)
        archive.writestr("modelDescription.xml", THIRD if fmi == 3 else SECOND)
    return path
