"""Every include of src/ against the list of rooms in CMakeLists.txt: who may use whom, and which library; no circles."""
import os
import re
import subprocess

SOURCE = os.environ.get("ORTHOSTAT_SOURCE", os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
PROGRAM = "cli"
MOST_FILES, MOST_LINES = 26, 600

# The headers of a library, and the one part of src/ that includes them (None: each room that lists the library).
LIBRARIES = {
    "Orthostat::Trilinos": (r"(ml_|az_|Epetra|Amesos|Aztec|Teuchos|Ifpack|Tpetra|MueLu|Belos)", "algebra/trilinos"),
    "Orthostat::HDF5": (r"(hdf5|H5)", "formats"),
    "Orthostat::NetCDF": (r"netcdf", "formats/exodus"),
    "Orthostat::GmshHeader": (r"gmsh", "formats"),
    "Orthostat::ZLIB": (r"zlib\.h", "formats"),
    "Orthostat::METIS": (r"(par)?metis\.h", "mesh algebra/level"),
    "Orthostat::YAML": (r"yaml\.h", "case"),
    "Orthostat::MUMPS": (r".mumps", "algebra/direct"),
    "Orthostat::JSON": (r"jansson\.h", None),
}
KEYWORDS = {"FLOOR", "USES", "HEADERS", "LIBRARIES"}


class Room:
    def __init__(self, name, given):
        self.name = name
        self.floor = int(given["FLOOR"][0])
        self.words = given["USES"]
        self.headers = given["HEADERS"]
        self.libraries = given["LIBRARIES"]
        self.uses = set()


def read_rooms():
    """{name: Room} in the order of the list."""
    with open(os.path.join(SOURCE, "CMakeLists.txt")) as stream:
        text = re.sub(r"#.*", "", stream.read())
    rooms = {}
    for call in re.findall(r"^\s*orthostat_room\(([^)]*)\)", text, re.MULTILINE):
        name, *words = call.split()
        given = {keyword: [] for keyword in KEYWORDS}
        for word in words:
            if word in KEYWORDS:
                keyword = word
            else:
                given[keyword].append(word)
        rooms[name] = Room(name, given)
    return rooms


def resolve_uses(rooms, failures):
    """Names and floors become rooms, each of them listed above the room that uses it and on no higher floor."""
    above = []
    for room in rooms.values():
        for word in room.words:
            floors = re.fullmatch(r"(\d)(?:\.\.(\d))?", word)
            if floors:
                highest = floors[2] or floors[1]
                room.uses |= {other.name for other in above if int(floors[1]) <= other.floor <= int(highest)}
            elif word in {other.name for other in above}:
                room.uses.add(word)
            else:
                failures.append(f"CMakeLists.txt: {room.name} uses {word}, which is not listed above it")
        failures += [f"CMakeLists.txt: {room.name} on floor {room.floor} uses {name} on floor {rooms[name].floor}"
                     for name in room.uses if rooms[name].floor > room.floor]
        above.append(room)


def source_files(folder):
    """Paths of C and C++ files, relative to the folder."""
    found = []
    for place, _, names in os.walk(os.path.join(SOURCE, folder)):
        found += [os.path.relpath(os.path.join(place, name), os.path.join(SOURCE, folder)) for name in names
                  if name.endswith((".c", ".h", ".cpp"))]
    return sorted(found)


def read(path):
    with open(os.path.join(SOURCE, path)) as stream:
        return stream.read()


def includes_of(text):
    """[(path, is it in quotes?)]"""
    return [(path, mark == '"') for mark, path in
            re.findall(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', text, re.MULTILINE)]


def check_use(path, user, target, owner, rooms, failures):
    """`owner` is the room that `target` belongs to; `user` the one of the file that includes it."""
    if user != PROGRAM and owner != user and owner not in rooms[user].uses:
        failures.append(f"{path} includes {target}: {user} may not use {owner}")


def check_library(path, room, header, libraries, failures):
    for library, (pattern, home) in LIBRARIES.items():
        if not re.match(pattern, header) or (room == PROGRAM and home is None):
            continue
        if library not in libraries:
            failures.append(f"{path} includes <{header}>: {room} does not list {library}")
        elif home and not any(room == one or room.startswith(one + "/") for one in home.split()):
            failures.append(f"{path} includes <{header}>: {library} is for {home} alone")


def circles(graph):
    """The strongly connected components of more than one node (Tarjan)."""
    number, lowest, stack, found = {}, {}, [], []

    def visit(node):
        number[node] = lowest[node] = len(number)
        stack.append(node)
        for other in graph[node]:
            if other not in number:
                visit(other)
            if other in stack:
                lowest[node] = min(lowest[node], lowest[other])
        if lowest[node] == number[node]:
            component = [stack.pop()]
            while component[-1] != node:
                component.append(stack.pop())
            if len(component) > 1:
                found.append(sorted(component))

    for node in graph:
        if node not in number:
            visit(node)
    return found


def check_includes(rooms, failures):
    owner_of = {f"orthostat/{header}.h": room.name for room in rooms.values() for header in room.headers}
    files = source_files("src")
    graph = {os.path.splitext(path)[0]: set() for path in files}
    for path in files:
        room, unit = os.path.dirname(path), os.path.splitext(path)[0]
        if room != PROGRAM and room not in rooms:
            failures.append(f"src/{path}: the room {room} is not in the list of CMakeLists.txt")
            continue
        for target, quoted in includes_of(read(f"src/{path}")):
            if target in owner_of:
                check_use(f"src/{path}", room, target, owner_of[target], rooms, failures)
            elif target in files:
                check_use(f"src/{path}", room, target, os.path.dirname(target), rooms, failures)
                graph[unit].add(os.path.splitext(target)[0])
            elif quoted:
                failures.append(f"src/{path} includes {target}, which is neither in src/ nor a HEADER of a room")
            else:
                check_library(f"src/{path}", room, target, rooms[room].libraries if room in rooms else [], failures)
        graph[unit].discard(unit)
    failures += ["a circle between files: " + ", ".join(circle) for circle in circles(graph)]
    check_public_includes(rooms, owner_of, failures)


def check_public_includes(rooms, owner_of, failures):
    """A public header belongs to one room and obeys it; orthostat.h holds them all, and is included by none."""
    headers = source_files("include/orthostat")
    graph = {header: set() for header in headers}
    for header in headers:
        path, room = f"include/orthostat/{header}", owner_of.get(f"orthostat/{header}")
        targets = [target for target, _ in includes_of(read(path))]
        if header == "orthostat.h":
            missing = {f"orthostat/{name}" for name in headers if name != header} - set(targets)
            failures += [f"{path} does not include {name}" for name in sorted(missing)]
        elif room is None:
            failures.append(f"{path}: no room of CMakeLists.txt lists it among its HEADERS")
        else:
            for target in targets:
                if target in owner_of:
                    check_use(path, room, target, owner_of[target], rooms, failures)
                    graph[header].add(os.path.basename(target))
                elif target.startswith("orthostat/") or target in ("config.h", "jansson.h", "yaml.h", "hdf5.h"):
                    failures.append(f"{path} includes {target}, which is no header of a concept")
    failures += [f"{name}: there is no include/{name}" for name in owner_of if name[10:] not in headers]
    failures += ["a circle between public headers: " + ", ".join(circle) for circle in circles(graph)]


def check_sizes(failures):
    count = {}
    for path in source_files("src"):
        count[os.path.dirname(path)] = count.get(os.path.dirname(path), 0) + 1
        lines = read(f"src/{path}").count("\n")
        if lines > MOST_LINES:
            failures.append(f"src/{path} has {lines} lines, more than {MOST_LINES}")
    failures += [f"src/{room} has {files} files, more than {MOST_FILES}" for room, files in sorted(count.items())
                 if files > MOST_FILES]


def check_guards(failures):
    for folder, prefix in (("src", "ORTHOSTAT_"), ("include", "")):
        for path in source_files(folder):
            guard = prefix + re.sub(r"\W", "_", path).upper()
            if path.endswith(".h") and f"#ifndef {guard}\n#define {guard}\n" not in read(f"{folder}/{path}"):
                failures.append(f"{folder}/{path}: its include guard is not {guard}")


def check_public_headers_stand_alone(failures):
    """Each compiles alone, as C and as C++."""
    for header in source_files("include/orthostat"):
        for language, compiler, standard in (("c", "mpicc", "c11"), ("c++", "mpicxx", "c++17")):
            command = [compiler, "-x", language, f"-std={standard}", "-fsyntax-only", "-Wall", "-Wextra", "-Wpedantic",
                       "-Wshadow", "-Werror", "-DOMPI_SKIP_MPICXX", "-I", os.path.join(SOURCE, "include"), "-"]
            unit = f'#include "orthostat/{header}"\nint main(void);\n'
            finished = subprocess.run(command, input=unit, capture_output=True, text=True)
            if finished.returncode != 0:
                failures.append(f"include/orthostat/{header} as {language}:\n{finished.stderr}")


def main():
    failures = []
    rooms = read_rooms()
    if len(rooms) < 10:
        raise SystemExit(f"FAILED: only {len(rooms)} rooms were found in CMakeLists.txt")
    resolve_uses(rooms, failures)
    check_includes(rooms, failures)
    check_sizes(failures)
    check_guards(failures)
    check_public_headers_stand_alone(failures)
    if failures:
        raise SystemExit("FAILED:\n" + "\n".join(failures))


main()
