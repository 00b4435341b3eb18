#!/usr/bin/env python3
"""Every effect of the registry has words on the page. usage: effect_words_test.py FOLDER"""
import pathlib
import re
import sys


def main():
    folder = pathlib.Path(sys.argv[1])
    specs = "".join(path.read_text(encoding="utf-8") for path in sorted((folder / "model/effects").rglob("*.h")))
    effects = set(re.findall(r'kSpec\s*=\s*\{\s*"(\w+)"', specs))
    words = (folder / "web/src/lib/effect_words.ts").read_text(encoding="utf-8")
    known = set(re.findall(r"^  (\w+): '", words, flags=re.M))
    missing = sorted(effects - known)
    print("\n".join(f"{effect} has no words" for effect in missing) or f"{len(effects)} effects")
    return 1 if missing or not effects else 0


if __name__ == "__main__":
    sys.exit(main())
