#!/usr/bin/env python3
"""Writes the generated pages of the reference: what the program says of itself, so that the two cannot differ.

usage: docs/generate/reference.py PROGRAM FOLDER"""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import answers  # noqa: E402
import commands  # noqa: E402
import effects  # noqa: E402
import http_api  # noqa: E402
import schemas  # noqa: E402
from pages import Meanings, code, table  # noqa: E402
from program import in_a_folder_of_its_own  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
CHECKOUT = HERE.parents[1]

FIELDS = """# {title}

{lead}

A field in **bold** must be given; others have the default that their meaning names, or are left out. `null` is as if a
field were not there. A number whose name ends in a unit may also be [a text with another unit](../input.md#units), and
every object may carry a `note`, which comes back unchanged. `*` stands for each entry of a list. The fields and ranges are
those of the readers that check a request.
"""
ANSWER = """# {title}

{lead}

`*` stands for each entry of a list. Fields may be added in later versions; none changes its meaning.
"""
REQUESTS = [
    ("requirements", "Requirements", "Requirements", "`requirements/1`: what `plenum design FILE` and `POST /v1/designs` "
     "take. [Lists, fronts, robustness, explanations](../requests.md) says more of the optional parts."),
    ("evaluation", "Evaluation", "Evaluation", "`evaluation/1`: what `plenum evaluate FILE` and `POST /v1/evaluations` "
     "take; `requirements` are those of [a search](requirements.md)."),
    ("simulation", "Simulation", "Simulation", "`simulation/1`: what `plenum simulate FILE` and `POST /v1/simulations` "
     "take. [Effects](effects.md) have a page of their own."),
    ("map", "Map", "Map", "`map/1`: what `plenum map FILE` and `POST /v1/maps` take. Pressures are ratios to ambient "
     "pressure, times are multiplied by C·P0/V0, flows divided by C·P0, volumes by V0."),
    ("measurement", "Measurement", "Measurement", "`measurement/1`: what `plenum diagnose FILE` and `POST /v1/diagnoses` "
     "take. [Diagnosis](../diagnosis.md) says what comes of it."),
]


def requests(schemas_of_service, meanings):
    for name, key, title, lead in REQUESTS:
        yield name, FIELDS.format(title=title, lead=lead) + schemas.tables(schemas_of_service[key], "request", meanings)


def example_answers(program):
    """Answers that together have every part of designs/1."""
    front = program.example("gripper") | {"objective": {"pareto": ["mass_kg", "volume_l"]}}
    judged = program.example("gripper") | {"robust": {"draws": 20}, "explain": {"prices": True, "ranks": 2}}
    judged["own"] = ["smc-vq110u-5m-m5"]
    impossible = program.example("gripper")
    impossible["actuators"][0]["rise_time_s_max"] = "1 ms"
    priced = program.example("gripper") | {"prices": "lower_bound", "objective": {"minimize": "cost_eur"}}
    program.text("diagnose", program.file("recording.json", program.example("simulated_recording")), "--save", "wall")
    revised = program.example("gripper") | {"model": "wall", "ranking": {"count": 3, "time_limit_s": 5}}
    judged["ranking"] = {"proof": True}
    bottled = program.example("tank_arm")
    bottled["supply"] = {"configurations": ["cylinder"]}
    in_packs = program.example("mckibben_glove")
    in_packs["supply"] = {"configurations": ["co2"]}
    documents = [priced, in_packs, revised, program.example("exosuit"), program.example("gripper_guaranteed"), front, judged, impossible,
                 program.example("tank_arm"), bottled,
                 program.example("orthosis"), program.example("refilled_arm")]
    return [program.answer("design", one) for one in documents]


def beside_the_first(program):
    """An evaluation of a design beside the first of a list, one requirement of which it misses."""
    asked = program.example("gripper_by_hand")
    asked["beside"] = program.answer("design", asked["requirements"])["designs"][0]
    asked["design"]["settings"]["source_pressure_kpa_gauge"] = 60.5
    return asked


def answer_pages(program, schemas_of_service, meanings):
    text = ANSWER.format(title="Designs: the answer", lead="`designs/1`: what `plenum design FILE --json` prints and a design "
                         "job answers. Made of answers to examples: a list, a guaranteed list, a front, draws and prices, "
                         "a request that nothing meets, a tank, a saved model.")
    yield "designs", text + answers.tables(example_answers(program), "answer", meanings)
    lead = "`{0}/1`: what {1}."
    for name, key, of in (("diagnosis", "Diagnosis", "`plenum diagnose FILE --json` prints and a diagnosis job answers"),
                          ("protocol", "Protocol", "`plenum protocol PART --json` prints and `GET /v1/parts/{id}/protocol` "
                           "answers")):
        yield name, ANSWER.format(title=f"{key}: the answer", lead=lead.format(name, of)) + schemas.tables(
            schemas_of_service[key], "answer", meanings)
    for name, title, command, document in (
            ("response", "Simulation: the answer", "simulate", program.example("simulation_effects")),
            ("map_answer", "Map: the answer", "map", program.example("map")),
            ("evaluation_answer", "Evaluation: the answer", "evaluate", beside_the_first(program))):
        yield name, ANSWER.format(title=title, lead=f"What `plenum {command} FILE --json` answers, from an example.") \
            + answers.tables([program.answer(command, document)], "answer", meanings)
    result = program.answer("design", program.example("gripper") | {"ranking": {"proof": True, "count": 2}})
    checked = json.loads(program.text("verify", program.file("result.json", result), "--json"))
    yield "verification_answer", ANSWER.format(title="Verification: the answer", lead="What `plenum verify FILE --json` "
                                               "answers, from an example.") + answers.tables([checked], "answer", meanings)


def limits_page(limits, meanings):
    text = "# Limits\n\nHow much a request may ask for, as `GET /v1/limits` gives it; a refusal names its limit.\n\n"
    return text + table(("limit", "value", "of what"), [(code(name), f"{value:,.10g}", meanings.of("limits", name))
                                                        for name, value in limits.items()])


def families_page(families):
    text = ("# Families of parts\n\nThe fields that a part of each family has, with their ranges, as `GET /v1/families` "
            "gives them. A field in **bold** must be given before a part can be ranked. *For the search*: what more of it "
            "does. Fields that every part has stand in [the catalogue](../catalogue.md).\n")
    for family in families:
        text += f"\n## {family['name']}\n"
        rows = [(bold(one), f"{one['min']:g} to {one['max']:g}", one["meaning"], one["search"] or "")
                for one in family["numbers"]]
        rows += [(bold(one), ", ".join(map(code, one["allowed"])) or "text", one["meaning"], one["search"] or "")
                 for one in family["texts"]]
        text += table(("field", "takes", "meaning", "for the search"), rows)
        if family["has_curve"]:
            text += "\nand a `curve`: rows of `pressure_kpa_gauge`, `free_air_l_per_min`, `current_a`.\n"
    return text


def bold(one):
    return f"**{code(one['name'])}**" if one["required"] else code(one["name"])


def pages(program, meanings):
    yield "commands", commands.page(program.text("--man"))
    with program.service() as get:
        api = get("/openapi.json")
        yield "limits", limits_page(get("/v1/limits")["limits"], meanings)
        yield "families", families_page(get("/v1/families")["families"])
    of_service = api["components"]["schemas"]
    yield "http_api", http_api.page(api)
    yield "effects", effects.page(of_service["Model"], CHECKOUT, meanings)
    yield from requests(of_service, meanings)
    yield from answer_pages(program, of_service, meanings)


def main():
    binary, folder = sys.argv[1:]
    target = pathlib.Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    meanings = Meanings(HERE / "meanings.toml")
    with in_a_folder_of_its_own(binary, CHECKOUT) as program:
        for name, text in pages(program, meanings):
            (target / f"{name}.md").write_text(text, encoding="utf-8")
    for fault in meanings.faults():
        print(f"docs/generate/meanings.toml: {fault}", file=sys.stderr)
    return 1 if meanings.faults() else 0


if __name__ == "__main__":
    sys.exit(main())
