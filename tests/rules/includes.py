"""Rules on includes: directions of rooms and sub-rooms, cycles, libraries, a header for each .cc."""
import fnmatch
import re

from tree import Violation, lies_in


def check_includes(sources, rules):
    yield from check_rooms(sources, rules["rooms"])
    yield from check_order(sources, rules["rooms"])
    yield from check_cycles(sources)
    yield from check_libraries(sources, rules["libraries"])
    yield from check_headers(sources)
    yield from check_stems(sources)


def reachable(sources):
    """Of each file all that it includes, whatever lies between: name -> the include before it."""
    reached = {}
    for path in sources:
        seen = {}
        queue = [path]
        while queue:
            at = queue.pop()
            for include in sources[at].includes:
                if include not in seen:
                    seen[include] = at
                    if include in sources:
                        queue.append(include)
        reached[path] = seen
    return reached


def way_to(path, include, seen):
    """path > header > include, the way on which a file comes to see an include."""
    way = [include]
    while way[-1] != path:
        way.append(seen[way[-1]])
    return " > ".join(reversed(way))


def check_rooms(sources, rooms):
    """A file sees its own room and what `sees` names, directly and through others."""
    allowed = {room: closure(room, rooms) for room in rooms}
    for path, seen in reachable(sources).items():
        source = sources[path]
        for include in sorted(set(source.includes)):
            if include.startswith(("./", "../")):
                yield Violation("room", path, 1, f'"{include}" is a relative path')
            elif include.split("/")[0] in ("tests", "bench"):
                yield Violation("room", path, 1, f"may not include {include}")
            elif include in sources and not lies_in(
                include, [source.room, *rooms[source.room]["sees"]]
            ):
                yield Violation("room", path, 1, f"may not include {include}")
        for include in sorted(seen):
            if include in sources and not lies_in(include, allowed[source.room]):
                if include not in source.includes:
                    way = way_to(path, include, seen)
                    yield Violation("room", path, 1, f"comes to see {include}: {way}")


def closure(room, rooms):
    """The room and all that it may see, through others too."""
    found = {room}
    queue = [room]
    while queue:
        for place in rooms.get(queue.pop(), {"sees": []})["sees"]:
            if place not in found:
                found.add(place)
                queue.append(place)
    return found


def check_order(sources, rooms):
    """Each sub-room and top file sees those before it in the order of its room."""
    places = {(source.room, source.place) for source in sources.values()}
    for room, rules in rooms.items():
        for place in rules["order"]:
            if (room, place) not in places:
                yield Violation("order", f"{room}/{place}", 1, "stands in rules.toml and nowhere else")
    for source in sources.values():
        order = rooms[source.room]["order"]
        if source.place not in order:
            yield Violation("order", source.path, 1, f"{source.place} is not in rules.toml")
            continue
        for include in source.includes:
            other = sources.get(include)
            if other is None or other.room != source.room or other.place not in order:
                continue
            if order.index(other.place) > order.index(source.place):
                detail = f"{source.place} comes before {other.place} and may not include {include}"
                yield Violation("order", source.path, 1, detail)


def check_cycles(sources):
    """No cycle of units, a unit being the .h and .cc of one name."""
    graph = {source.unit: set() for source in sources.values()}
    for source in sources.values():
        for include in source.includes:
            if include in sources and sources[include].unit != source.unit:
                graph[source.unit].add(sources[include].unit)
    for members in strong_components(graph):
        if len(members) > 1:
            names = sorted(members)
            yield Violation("cycle", names[0], len(names), "includes go round: " + ", ".join(names))


def strong_components(graph):
    """Tarjan's algorithm without recursion."""
    index, low, on_stack, stack, components = {}, {}, set(), [], []
    for root in sorted(graph):
        if root in index:
            continue
        work = [(root, iter(sorted(graph[root])))]
        index[root] = low[root] = len(index)
        stack.append(root)
        on_stack.add(root)
        while work:
            node, rest = work[-1]
            following = next(rest, None)
            if following is None:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[node])
                if low[node] == index[node]:
                    component = []
                    while not component or component[-1] != node:
                        component.append(stack.pop())
                        on_stack.discard(component[-1])
                    components.append(component)
            elif following not in index:
                index[following] = low[following] = len(index)
                stack.append(following)
                on_stack.add(following)
                work.append((following, iter(sorted(graph[following]))))
            elif following in on_stack:
                low[node] = min(low[node], index[following])
    return components


def check_libraries(sources, libraries):
    """A library's headers stay in its rooms; where they leak through others, the border is named."""
    seen_by = reachable(sources)
    for name, library in libraries.items():
        pattern = re.compile(library["headers"])
        reach = library.get("reach", []) + library["rooms"]
        for path, source in sources.items():
            direct = sorted(i for i in source.includes if pattern.match(i))
            if direct:
                if not lies_in(path, library["rooms"]):
                    yield Violation("library", path, 1, f"may not include {name} ({direct[0]})")
                continue
            hidden = sorted(i for i in seen_by[path] if pattern.match(i) and i not in sources)
            if not hidden or lies_in(path, reach):
                continue
            way = way_to(path, hidden[0], seen_by[path])
            if lies_in(way.split(" > ")[1], reach):  # those behind see it through this file
                yield Violation("library", path, 1, f"comes to see {name}: {way}")


def check_headers(sources):
    """Every .cc has its header, or a header of its folder names it as one that it serves."""
    named = {}  # folder -> names of .cc files in comments of its headers, with * for any text
    for source in sources.values():
        if source.path.endswith(".h"):
            for comment in re.findall(r"//.*", source.text):
                named.setdefault(source.folder, set()).update(re.findall(r"[\w*]+\.cc\b", comment))
    for path, source in sources.items():
        if path.endswith(".h") or f"{source.unit}.h" in sources or re.search(r"\bint main\(", source.text):
            continue
        if not any(fnmatch.fnmatch(f"{source.stem}.cc", n) for n in named.get(source.folder, [])):
            yield Violation("header", path, 1, "has no header, and none of its folder names it")


def check_stems(sources):
    """No file name twice across rooms, so that a name says which file is meant."""
    units = {}
    for source in sources.values():
        units.setdefault(source.stem, set()).add(source.unit)
    for stem, same in sorted(units.items()):
        if len(same) > 1:
            yield Violation("stem", stem, len(same), "stands in " + ", ".join(sorted(same)))
