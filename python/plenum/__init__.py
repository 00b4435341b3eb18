"""Chooses the parts of a pneumatic supply for soft robots, proves the choice, and diagnoses measured pressures.

    import plenum
    designs = plenum.design("exosuit.json")
    designs.plot()
"""
from ._core import version as __version__
from .answers import Answer, Design, Designs, Diagnosis, Evaluation, Map, Protocol, Response, SweepTable, Verification
from .catalogue import Catalogue
from .errors import CatalogueError, Error, InputError, ServiceError
from .local import design, diagnose, evaluate, protocol, simulate, simulate_many, sweep, verify
from .local import map as map  # not in __all__: there it would hide the map of Python
from .service import Service, connect

__all__ = [
    "Answer", "Catalogue", "CatalogueError", "Design", "Designs", "Diagnosis", "Error", "Evaluation", "InputError",
    "Map", "Protocol", "Response", "Service", "ServiceError", "SweepTable", "Verification", "__version__", "connect",
    "design", "diagnose", "evaluate", "protocol", "simulate", "simulate_many", "sweep", "verify",
]
