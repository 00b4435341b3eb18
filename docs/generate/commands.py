"""The page of all commands and options, from the manual page, which is made of the table of options."""
import re

from pages import code, table

HEAD = """# All commands and options

Made of what `plenum --man` prints. What commands have in common stands in [the command](../commands.md).
"""


def plain(line):
    """A line of man(7) without its escapes and fonts."""
    return re.sub(r"\\f[BR]", "", line).replace("\\&", "").replace("\\-", "-").replace("\\e", "\\")


def sections(manual):
    """(name, [lines]) of each command."""
    for piece in re.split(r"^\.SS ", manual, flags=re.M)[1:]:
        name, _, body = re.split(r"^\.SH ", piece, flags=re.M)[0].partition("\n")
        yield plain(name.strip('"')), [plain(line) for line in body.splitlines()]


def parse(manual):
    """[(name, help, usage, [(option, help)], example)]"""
    commands = []
    for name, lines in sections(manual):
        usage = lines[lines.index(".PP") + 1]
        options = [(lines[i + 1], lines[i + 2]) for i, line in enumerate(lines) if line == ".TP"]
        example = lines[lines.index(".nf") + 1:lines.index(".fi")]
        commands.append((name, lines[0], usage, options, "\n".join(example)))
    return commands


def page(manual):
    text = HEAD
    for name, what, usage, options, example in parse(manual):
        text += f"\n## {name}\n{what}\n\n```text\n{usage}\n```\n"
        if options:
            text += table(("option", "does"), [(code(option), words) for option, words in options])
        text += f"\nExample: `{example}`\n"
    return text
