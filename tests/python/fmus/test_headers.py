"""The functions of the standards' own headers, as fmpy ships them: signatures, symbols, and an answer to every call."""

import re
import subprocess
from pathlib import Path

import fmpy
import pytest
from conftest import RELEASE, ROOT

HEADERS = Path(fmpy.__file__).parent / "c-code"
LIBRARY = RELEASE / "libjostle_wedge_event_driven_input.so"
COUNTS = {2: 44, 3: 75}

C_TYPES = {
    "void": "void",
    "char": "char",
    "size_t": "usize",
    "Real": "f64",
    "Integer": "i32",
    "Status": "i32",
    "Type": "i32",
    "StatusKind": "i32",
    "IntervalQualifier": "i32",
    "DependencyKind": "i32",
    "Char": "char",
    "String": "*const char",
    "Byte": "u8",
    "Binary": "*const u8",
    "ValueReference": "u32",
    "Float32": "f32",
    "Float64": "f64",
    "Clock": "u8",
    "CallbackFunctions": "CallbackFunctions",
    "EventInfo": "void",
    **{f"Int{bits}": f"i{bits}" for bits in (8, 16, 32, 64)},
    **{f"UInt{bits}": f"u{bits}" for bits in (8, 16, 32, 64)},
    **dict.fromkeys(("Component", "FMUstate", "Instance", "InstanceEnvironment", "FMUState"), "*mut void"),
    **{
        f"{name}Callback": "callback"
        for name in ("LogMessage", "IntermediateUpdate", "ClockUpdate", "LockPreemption", "UnlockPreemption")
    },
}
RUST_TYPES = {
    "Opaque": "*mut void",
    "c_void": "void",
    "c_char": "char",
    "c_int": "i32",
    "Status": "i32",
    "Enumeration": "i32",
    "Boolean": "u8",
}


def of_c(text: str, version: int) -> str:
    """A declaration of the header, such as `const fmi3Float64 values[]`, as Rust writes its type."""
    constant = text.strip().startswith("const ")
    words = re.sub(r"\bconst\b", "", text).replace("[]", " [] ").replace("*", " * ").split()
    depth = words.count("[]") + words.count("*")
    name = words[0].removeprefix(f"fmi{version}")
    base = {"Boolean": {2: "i32", 3: "u8"}[version]}.get(name) or C_TYPES[name]
    return ("*const " if constant else "*mut ") * min(depth, 1) + base


def of_rust(text: str) -> str:
    if text.startswith("Option<"):
        return "callback"
    words = text.split()
    return " ".join([*words[:-1], RUST_TYPES.get(words[-1], words[-1])])


def declared(version: int) -> dict[str, tuple[str, list[str]]]:
    """Result and argument types of every function in the header."""
    text = (HEADERS / f"fmi{version}FunctionTypes.h").read_text()
    text = re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.DOTALL)
    found = re.findall(rf"typedef\s+([\w\s*]+?)\s*\b(fmi{version}\w+)TYPE\s*\(([^)]*)\)\s*;", text)
    table = {}
    for result, name, arguments in found:
        kinds = [of_c(argument, version) for argument in arguments.split(",") if argument.strip() not in ("", "void")]
        table[name] = (of_c(result, version), kinds)
    return table


def exported(version: int) -> dict[str, tuple[str, list[str]]]:
    """The same of the two tables from which the library's functions are made.

    The second has the calls of an instance: that is their first argument, and a status their result.
    """
    text = (ROOT / f"crates/fmi-component/src/c_api/export_fmi{version}.rs").read_text()
    functions, calls = text.split("$crate::__fmi_calls!")
    table = {}
    for part, first, status in ((functions, [], "void"), (calls, ["*mut void"], "i32")):
        for name, arguments, result in re.findall(r"\bfn (fmi\w+)\(([^)]*)\)(?: -> ([^=]+?))? =\s", part):
            kinds = [of_rust(argument.split(":")[1].strip()) for argument in arguments.split(",") if ":" in argument]
            table[name] = (of_rust(result.strip()) if result else status, first + kinds)
    return table


@pytest.mark.parametrize("version", [2, 3])
def test_signatures_are_those_of_the_header(version: int):
    header, ours = declared(version), exported(version)
    assert len(header) == COUNTS[version]
    assert sorted(ours) == sorted(header)
    for name, signature in header.items():
        assert ours[name] == signature, name


@pytest.mark.parametrize("version", [2, 3])
def test_symbols_are_those_of_the_header(version: int):
    symbols = subprocess.run(["nm", "-D", "--defined-only", LIBRARY], capture_output=True, text=True, check=True).stdout
    found = {line.split()[-1] for line in symbols.splitlines()}
    assert set(declared(version)) == {name for name in found if name.startswith(f"fmi{version}")}


FMI2 = """
static void log_it(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                   fmi2String message, ...) {
    (void)environment; (void)name; (void)status; (void)category; (void)message;
}
static const fmi2CallbackFunctions callbacks = {log_it, NULL, NULL, NULL, NULL};
static fmi2Component make(const char *token) {
    fmi2InstantiateTYPE *instantiate = (fmi2InstantiateTYPE *)find("fmi2Instantiate");
    return instantiate("a", fmi2CoSimulation, token, "", &callbacks, fmi2False, fmi2False);
}
"""
FMI3 = """
static fmi3Instance make(const char *token) {
    fmi3InstantiateCoSimulationTYPE *instantiate =
        (fmi3InstantiateCoSimulationTYPE *)find("fmi3InstantiateCoSimulation");
    return instantiate("a", token, NULL, false, false, false, false, NULL, 0, NULL, NULL, NULL);
}
"""


def program(version: int) -> str:
    """Calls every function with nothing, on no instance and on a new one; the next call must find the library alive."""
    text = re.sub(r"/\*.*?\*/", "", (HEADERS / f"fmi{version}FunctionTypes.h").read_text(), flags=re.DOTALL)
    calls = []
    for name, (result, kinds) in declared(version).items():
        arguments = re.search(rf"\b{name}TYPE\s*\(([^)]*)\)", text).group(1).split(",")  # type: ignore[union-attr]
        if not kinds or name.startswith(f"fmi{version}Instantiate"):
            continue
        for instance in ("NULL", "make(token)"):
            values = [instance] + ["0" if "[]" not in a and "*" not in a else "NULL" for a in arguments[1:]]
            call = f'(({name}TYPE *)find("{name}"))({", ".join(values)})'
            if result == "i32" and instance == "NULL":
                calls.append(f'    if ({call} != fmi{version}Error) fail("{name}");')
            elif result == "i32":
                calls.append(f'    if ({call} >= fmi{version}Fatal) fail("{name}");')
            else:
                calls.append(f"    {call};")
    body = "\n".join(calls)
    return f"""#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include "fmi{version}FunctionTypes.h"
static void *library;
static void fail(const char *what) {{ printf("%s\\n", what); exit(1); }}
static void (*find(const char *name))(void) {{
    union {{ void *object; void (*function)(void); }} symbol = {{dlsym(library, name)}};
    if (!symbol.object) fail(name);
    return symbol.function;
}}
{FMI2 if version == 2 else FMI3}
int main(int count, char **arguments) {{
    library = count == 3 ? dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL) : NULL;
    if (!library) fail("no library");
    const char *token = arguments[2];
    if (!make(token)) fail("no instance");
{body}
    printf("all answered\\n");
    return 0;
}}
"""


@pytest.mark.parametrize("version", [2, 3])
def test_every_function_answers(tmp_path: Path, version: int):
    """Compiled against the header itself, with every warning an error."""
    (tmp_path / "every.c").write_text(program(version))
    flags = ["-std=c11", "-Wall", "-Wextra", "-Werror", f"-I{HEADERS}"]
    subprocess.run(["gcc", *flags, "-o", tmp_path / "every", tmp_path / "every.c", "-ldl"], check=True)
    description = (ROOT / f"modelDescription/jostle_wedge_event_driven_input.fmi{version}.xml").read_text()
    (token,) = re.findall(r'(?:guid|instantiationToken)="([^"]*)"', description)
    done = subprocess.run([tmp_path / "every", LIBRARY, token], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "all answered\n")
