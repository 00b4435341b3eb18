#!/usr/bin/env python3
"""The built pages ask nobody else, run no script but those of their files, as the policy of the service wants it, and
lead only to what is there. usage: pages_test.py FOLDER"""
import html.parser
import pathlib
import re
import sys
import urllib.parse

SKIPPED = 77
LOADS = {"script": "src", "img": "src", "iframe": "src", "source": "src", "link": "href"}
NOT_LOADED = {"index", "search", "next", "prev", "canonical", "author", "up"}  # of <link rel=…>


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.ids, self.links, self.faults = set(), [], []
        self.inline = False
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.ids.update(value for name, value in attributes if name in ("id", "name") and value)
        self.faults += [f"a handler {name} of <{tag}>" for name in given if name.startswith("on")]
        self.inline = tag == "script" and "src" not in given
        target = given.get(LOADS.get(tag, ""), "")
        loads = tag in LOADS and given.get("rel") not in NOT_LOADED
        if loads and re.match(r"(\w+:)?//", target):
            self.faults.append(f"<{tag}> loads {target}")
        elif loads and target and not target.startswith("data:"):
            self.links.append(target)
        if tag == "a" and given.get("href"):
            self.links.append(given["href"])

    def handle_data(self, data):
        if self.inline and data.strip():
            self.faults.append("a script in the page")
        self.inline = False


def broken(page, links, pages, folder):
    for link in links:
        parts = urllib.parse.urlsplit(link)
        if parts.scheme or parts.netloc:
            continue
        target = (page.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else page
        if folder not in (target, *target.parents) or not target.exists():
            yield f"{link} leads nowhere"
        elif parts.fragment and target in pages and parts.fragment not in pages[target].ids | {"", "top"}:
            yield f"{link} has no such place"


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    if not (folder / "index.html").exists():
        print("the documentation is not built here", file=sys.stderr)
        return SKIPPED
    pages = {path: Page(path) for path in sorted(folder.rglob("*.html"))}
    faults = []
    for path, page in pages.items():
        found = [*page.faults, *broken(path, page.links, pages, folder)]
        faults += [f"{path.relative_to(folder)}: {fault}" for fault in dict.fromkeys(found)]
    for path in folder.rglob("*.css"):
        faults += [f"{path.relative_to(folder)} loads {url}" for url in
                   re.findall(r"(?:url\(|@import\s+)[\"']?((?:\w+:)?//[^\"')]+|/[^\"')]+)", path.read_text(encoding="utf-8"))]
    print("\n".join(faults) or f"{len(pages)} pages")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
