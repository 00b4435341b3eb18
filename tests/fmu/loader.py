"""Loads a functional mock-up unit by the standard (FMI 2.0) alone: the archive, its description, its binary."""
import ctypes
import pathlib
import xml.etree.ElementTree
import zipfile

OK, DISCARD, ERROR = 0, 2, 3


class Callbacks(ctypes.Structure):
    LOGGER = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p,
                              ctypes.c_char_p)
    _fields_ = [("logger", LOGGER), ("allocate", ctypes.c_void_p), ("free", ctypes.c_void_p),
                ("finished", ctypes.c_void_p), ("environment", ctypes.c_void_p)]


class Unit:
    """One instance, at its start; variables by their names."""

    def __init__(self, file, folder, name="it", guid=None, parameters=()):
        folder = pathlib.Path(folder)
        with zipfile.ZipFile(file) as archive:
            assert archive.testzip() is None
            archive.extractall(folder)
        self.description = xml.etree.ElementTree.parse(folder / "modelDescription.xml").getroot()
        self.variables = {v.get("name"): v for v in self.description.find("ModelVariables")}
        self.references = {n: int(v.get("valueReference")) for n, v in self.variables.items()}
        self.kinds = {n: v[0].tag for n, v in self.variables.items()}
        identifier = self.description.find("CoSimulation").get("modelIdentifier")
        self.library = ctypes.CDLL(str(folder / "binaries" / "linux64" / (identifier + ".so")))
        self.library.fmi2Instantiate.restype = ctypes.c_void_p
        self.library.fmi2GetVersion.restype = self.library.fmi2GetTypesPlatform.restype = ctypes.c_char_p
        self.library.fmi2FreeInstance.restype = None
        assert self.library.fmi2GetVersion() == b"2.0"
        assert self.library.fmi2GetTypesPlatform() == b"default"
        self.said = []
        self.callbacks = Callbacks(Callbacks.LOGGER(lambda _, __, ___, ____, form, text: self.said.append(text.decode())))
        instance = self.library.fmi2Instantiate(
            name.encode(), 1, (guid or self.description.get("guid")).encode(),
            (folder / "resources").as_uri().encode(), ctypes.byref(self.callbacks), 0, 1)
        if not instance:
            raise RuntimeError("; ".join(self.said))
        self.instance = ctypes.c_void_p(instance)
        self.time = 0.0
        self.ok("SetupExperiment", 0, ctypes.c_double(0), ctypes.c_double(0), 0, ctypes.c_double(0))
        for name, value in dict(parameters).items():
            self[name] = value
        self.ok("EnterInitializationMode")
        self.ok("ExitInitializationMode")

    def call(self, function, *arguments):
        return getattr(self.library, "fmi2" + function)(self.instance, *arguments)

    def ok(self, function, *arguments):
        status = self.call(function, *arguments)
        assert status == OK, (function, status, self.said)

    FORMS = {"Real": ctypes.c_double, "Integer": ctypes.c_int, "Boolean": ctypes.c_int}

    def __getitem__(self, name):
        kind = self.kinds[name]
        value = self.FORMS[kind]()
        self.ok("Get" + kind, (ctypes.c_uint * 1)(self.references[name]), ctypes.c_size_t(1), ctypes.byref(value))
        return value.value

    def set(self, name, value):
        kind = self.kinds[name]
        return self.call("Set" + kind, (ctypes.c_uint * 1)(self.references[name]), ctypes.c_size_t(1),
                         ctypes.byref(self.FORMS[kind](value)))

    def __setitem__(self, name, value):
        assert self.set(name, value) == OK, self.said

    def step(self, seconds):
        status = self.call("DoStep", ctypes.c_double(self.time), ctypes.c_double(seconds), 1)
        self.time += seconds
        assert status == OK, self.said

    def keep(self):
        state = ctypes.c_void_p()
        self.ok("GetFMUstate", ctypes.byref(state))
        return state

    def go_back(self, state):
        self.ok("SetFMUstate", state)
        self.ok("FreeFMUstate", ctypes.byref(state))

    def free(self):
        self.library.fmi2FreeInstance(self.instance)
