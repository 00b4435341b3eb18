"""A drawn request, its answer, and the questions that follow from it."""
import random
from dataclasses import dataclass, field

from plenum_program import Program, Ran, faults_of


@dataclass
class Finding:
    """What is wrong. `request`: what else was asked, besides the drawn request."""

    kind: str
    relation: str
    what: str
    request: dict | None = None


@dataclass
class Inquiry:
    """A drawn request, its answer, and what more questions have shown."""

    program: Program
    request: dict
    first: Ran
    draw: random.Random
    findings: list = field(default_factory=list)

    @property
    def limit_s(self):
        return self.request["ranking"]["time_limit_s"]

    def note(self, relation, broken, request=None):
        """`broken`: (kind, what), or None where all is well."""
        if broken:
            self.findings.append(Finding(broken[0], relation, broken[1], request))

    def ask(self, relation, request, may_refuse=()):
        """The answer to another request; None where it is refused. `may_refuse`: errors that are no fault."""
        ran = self.program.design(request)
        for fault in faults_of(ran, self.limit_s):
            self.note(relation, fault, request)
        if ran.exit_code == 2 and not any(ran.errors.startswith(place) for place in may_refuse):
            self.note(relation, ("refused", ran.errors[:300]), request)
        return ran if ran.status else None
