# SPDX-License-Identifier: Apache-2.0
"""Compares every #include between rooms with cmake/rooms.cmake, and the table of ARCHITECTURE.md with it. Every source
names its licence.

usage: check.py SOURCE_FOLDER
Prints each difference as file:line: what is wrong. Exit status 1 if there is one.
"""

import pathlib
import re
import sys

# Folders that may include every room, and folders without C++ of ours.
FREE = {"tests", "bench", "build", "docs"}
SPDX = "SPDX-License-Identifier: Apache-2.0"
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')
# Headers of the installed library are included as its users include them.
INSTALLED = re.compile(r"^\s*#\s*include\s+<(navcal/[^>]+)>")
INSTALLED_FOLDER = "api/include/"


def table_of(text):
    """{room: set of rooms it may include} from the text of rooms.cmake."""
    rooms = re.search(r"set\(NAVCAL_ROOMS ([^)]*)\)", text).group(1).split()
    allowed = {}
    for room, names in re.findall(r"set\(NAVCAL_MAY_INCLUDE_([\w/]+)([^)]*)\)", text):
        allowed[room] = set(names.split())
    return rooms, allowed


def orders_of(text):
    """{room: [folders in the order in which they may use each other]} from the text of rooms.cmake."""
    found = re.findall(r"set\(NAVCAL_ORDER_([\w/]+) ([^)]*)\)", text)
    return {room: folders.split() for room, folders in found}


def problems_of_order(root, orders):
    """Includes within a room against the order of its folders, and orders that name no such folder."""
    for room, folders in orders.items():
        place = {f"{room}/{folder}": number for number, folder in enumerate(folders)}
        for folder in place:
            if not (root / folder).is_dir():
                yield f"cmake/rooms.cmake: there is no folder {folder}"
        for path in sorted([*root.glob(f"{room}/**/*.h"), *root.glob(f"{room}/**/*.cpp")]):
            name = path.relative_to(root)
            from_folder = name.parent.as_posix()
            for number, line in enumerate(path.read_text().splitlines(), 1):
                found = INCLUDE.match(line)
                to_folder = str(pathlib.PurePosixPath(found.group(1)).parent) if found else ""
                if to_folder not in place:
                    continue
                if from_folder == room and path.suffix == ".h":
                    yield f"{name}:{number}: a header of {room} may not include {to_folder} (cmake/rooms.cmake)"
                elif place.get(from_folder, len(place)) < place[to_folder]:
                    yield f"{name}:{number}: {from_folder} may not include {to_folder} (cmake/rooms.cmake)"


def problems_of_table(rooms, allowed):
    for room in rooms:
        if room not in allowed:
            yield f"cmake/rooms.cmake: no line NAVCAL_MAY_INCLUDE_{room}"
    for room, names in allowed.items():
        if room not in rooms:
            yield f"cmake/rooms.cmake: NAVCAL_ROOMS does not have {room}"
            continue
        for name in sorted(names):
            if name not in rooms:
                yield f"cmake/rooms.cmake: {room} may include {name}, which NAVCAL_ROOMS does not have"
            elif rooms.index(name) >= rooms.index(room):
                yield f"cmake/rooms.cmake: {room} may include {name}, which stands after it"


def room_of(name, rooms):
    """The innermost room in which a file lies, else its top-level folder."""
    inside = [room for room in rooms if name.startswith(room + "/")]
    return max(inside, key=len) if inside else name.split("/")[0]


def sources(root, rooms):
    for pattern in ("*.h", "*.cpp", "*.h.in", "*.cpp.in"):
        for path in sorted(root.glob(f"*/**/{pattern}")):
            folder = path.relative_to(root).parts[0]
            if folder not in FREE and not folder.startswith("."):
                yield room_of(path.relative_to(root).as_posix(), rooms), path


def included_by(line):
    """What a line includes of ours, from the root; empty if nothing."""
    if found := INCLUDE.match(line):
        return found.group(1)
    found = INSTALLED.match(line)
    return INSTALLED_FOLDER + found.group(1) if found else ""


def problems_of_includes(root, rooms, allowed):
    used = {room: set() for room in rooms}
    for room, path in sources(root, rooms):
        name = path.relative_to(root)
        if room not in rooms:
            yield f"{name}:1: the folder {room} is no room of cmake/rooms.cmake"
            continue
        is_installed = name.as_posix().startswith(INSTALLED_FOLDER)
        for number, line in enumerate(path.read_text().splitlines(), 1):
            included = included_by(line)
            if not included:
                continue
            other = room_of(included, rooms)
            if "/" not in included or other not in rooms:
                yield f'{name}:{number}: "{included}" is not in a room of cmake/rooms.cmake'
            elif is_installed and not included.startswith(INSTALLED_FOLDER):
                yield f'{name}:{number}: an installed header may include only <navcal/...>, not "{included}"'
            elif other != room and other not in allowed.get(room, set()):
                yield f"{name}:{number}: {room} may not include {other} (cmake/rooms.cmake)"
            else:
                used[room].add(other)
    for room in rooms:
        for other in sorted(allowed.get(room, set()) - used[room]):
            yield f"cmake/rooms.cmake: {room} may include {other}, and does not"


def problems_of_page(text, rooms, allowed):
    """ARCHITECTURE.md: one row `| `room/` | ... | rooms, libraries |` for each room, with the same rooms."""
    rows = {}
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        name = re.match(r"`([\w/]+)/`$", cells[0])
        if name and len(cells) == 3:
            rows[name.group(1)] = {word for word in re.findall(r"[a-z/]+", cells[2]) if word in rooms}
    for room in rooms:
        if room not in rows:
            yield f"ARCHITECTURE.md: no row for {room}"
        elif rows[room] != allowed.get(room, set()):
            yield f"ARCHITECTURE.md: the row of {room} should name {', '.join(sorted(allowed[room])) or 'no room'}"


def problems_of_licence(root):
    """Sources without an SPDX line among their first three."""
    for pattern in ("*.h", "*.cpp", "*.py", "*.mjs", "*.cmake", "CMakeLists.txt"):
        for path in sorted([*root.glob(pattern), *root.glob(f"*/**/{pattern}")]):
            name = path.relative_to(root)
            if name.parts[0] == "build" or name.parts[0].startswith(".") or "node_modules" in name.parts:
                continue
            with path.open() as file:
                if not any(SPDX in line for _, line in zip(range(3), file)):
                    yield f"{name}:1: no line {SPDX}"


def check(root):
    table = (root / "cmake/rooms.cmake").read_text()
    rooms, allowed = table_of(table)
    return [
        *problems_of_table(rooms, allowed),
        *problems_of_includes(root, rooms, allowed),
        *problems_of_order(root, orders_of(table)),
        *problems_of_page((root / "ARCHITECTURE.md").read_text(), rooms, allowed),
    ]


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1])
    found = [*check(folder), *problems_of_licence(folder)]
    for problem in found:
        print(problem)
    sys.exit(1 if found else 0)
