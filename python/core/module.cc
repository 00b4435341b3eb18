// The functions and their names for Python; their signatures stand in plenum/_core.pyi.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <utility>

#include "api/json/version.h"
#include "python/core/computations.h"
#include "python/core/documents.h"
#include "python/core/measured_parts.h"
#include "python/core/part_store.h"

namespace plenum::python {
namespace {

namespace py = pybind11;

// Errors of documents and of catalogues as the exceptions of plenum/errors.py.
void TranslateErrors(std::exception_ptr thrown) {
  const auto raise = [](const char* name, const py::object& arguments) {
    const py::object type = py::module_::import("plenum.errors").attr(name);
    PyErr_SetObject(type.ptr(), arguments.ptr());
  };
  try {
    if (thrown) std::rethrow_exception(std::move(thrown));
  } catch (const Refused& refused) {
    py::list errors;
    for (const api::Error& error : refused.errors())
      errors.append(py::make_tuple(error.pointer, error.detail));
    raise("InputError", errors);
  } catch (const catalog::StoreError& error) {
    raise("CatalogueError", py::str(error.what()));
  }
}

// Pairs of a text and its arrays.
py::list WithArrays(const std::vector<TextWithArrays>& answers) {
  py::list list;
  for (const TextWithArrays& answer : answers) {
    py::list arrays;
    for (const std::vector<double>& numbers : answer.arrays)
      arrays.append(py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data()));
    list.append(py::make_tuple(answer.text, arrays));
  }
  return list;
}

// Short work, in the thread of the caller.
template <auto function, typename... Arguments>
auto Released(const Arguments&... arguments) {
  const py::gil_scoped_release released;
  return function(arguments...);
}

void DefineCatalogue(py::module_& module) {
  using Text = std::string;
  module.def("locate_catalogue", Released<LocateCatalogue, Text, Text>, py::arg("path"),
             py::arg("seed"));
  module.def("parts", Released<Parts, Text, std::optional<Text>>, py::arg("catalogue"),
             py::arg("family") = py::none());
  module.def("families", Released<Families>);
  module.def("head", Released<Head, Text>, py::arg("catalogue"));
  module.def("add_part", Released<AddPart, Text, Text, bool, Text>, py::arg("catalogue"),
             py::arg("part"), py::arg("replace"), py::arg("who"));
  module.def("remove_part", Released<RemovePart, Text, Text, Text>, py::arg("catalogue"),
             py::arg("id"), py::arg("who"));
  module.def("import_table", Released<ImportTable, Text, Text, Text, bool, Text>,
             py::arg("catalogue"), py::arg("family"), py::arg("table"), py::arg("dry_run"),
             py::arg("who"));
  module.def("save_model", Released<SaveModel, Text, Text, Text, Text>, py::arg("catalogue"),
             py::arg("name"), py::arg("model"), py::arg("who"));
  module.def("models", Released<Models, Text>, py::arg("catalogue"));
}

void DefinePartTests(py::module_& module) {
  using Text = std::string;
  module.def(
      "protocol",
      [](const Text& catalogue, const Text& id, const std::map<Text, Text>& sensor) {
        return Released<Protocol, Text, Text, std::multimap<Text, Text>>(
            catalogue, id, {sensor.begin(), sensor.end()});
      },
      py::arg("catalogue"), py::arg("id"), py::arg("sensor"));
  module.def(
      "save_part",
      [](const Text& catalogue, const Text& id, const Text& diagnosis, const Text& specimen,
         bool anyway, const Text& who) {
        return Released<SavePart, Text, Text, Text, MeasuredBy>(catalogue, id, diagnosis,
                                                                {who, specimen, anyway});
      },
      py::arg("catalogue"), py::arg("id"), py::arg("diagnosis"), py::arg("specimen"),
      py::arg("anyway"), py::arg("who"));
  module.def(
      "write_measured",
      [](const Text& catalogue, const Text& id, const std::vector<Text>& readings,
         const Text& uncertainty, const Text& note, const Text& specimen, bool anyway,
         const Text& who) {
        return Released<WriteMeasured, Text, Text, std::vector<Text>, Text, Text, MeasuredBy>(
            catalogue, id, readings, uncertainty, note, {who, specimen, anyway});
      },
      py::arg("catalogue"), py::arg("id"), py::arg("readings"), py::arg("uncertainty"),
      py::arg("note"), py::arg("specimen"), py::arg("anyway"), py::arg("who"));
}

void DefineComputations(py::module_& module) {
  using Text = std::string;
  module.def(
      "design",
      [](const Text& requirements, const Text& catalogue, const py::object& progress) {
        return RunWatched(progress,
                          [&](Watch& watch) { return Design(requirements, catalogue, watch); });
      },
      py::arg("requirements"), py::arg("catalogue"), py::arg("progress") = py::none());
  module.def(
      "sweep",
      [](const Text& sweep, const Text& catalogue, const py::object& progress) {
        return RunWatched(progress, [&](Watch& watch) { return Sweep(sweep, catalogue, watch); });
      },
      py::arg("sweep"), py::arg("catalogue"), py::arg("progress") = py::none());
  module.def("evaluate", Released<Evaluate, Text, Text>, py::arg("request"), py::arg("catalogue"));
  module.def("simulate", Released<Simulate, Text, Text>, py::arg("request"), py::arg("catalogue"));
  module.def("map", Released<Map, Text>, py::arg("request"));
  module.def(
      "simulate_many",
      [](const std::vector<Text>& requests, const Text& catalogue, int threads,
         const py::object& progress) {
        return RunWatched(
            progress,
            [&](Watch& watch) { return SimulateMany(requests, catalogue, threads, watch); },
            WithArrays);
      },
      py::arg("requests"), py::arg("catalogue"), py::arg("threads"),
      py::arg("progress") = py::none());
  module.def(
      "diagnose",
      [](const std::vector<Text>& measurements, const Text& catalogue, const Text& model,
         double time_limit_s, const std::vector<std::pair<Text, Text>>& files,
         const py::object& progress) {
        const DiagnosisWish wish{model, time_limit_s, files};
        return RunWatched(
            progress, [&](Watch& watch) { return Diagnose(measurements, wish, catalogue, watch); });
      },
      py::arg("measurements"), py::arg("catalogue"), py::arg("model"), py::arg("time_limit_s"),
      py::arg("files"), py::arg("progress") = py::none());
  module.def("measurement_from_csv", Released<MeasurementFromCsv, Text, Text>, py::arg("csv"),
             py::arg("rig"));
  module.def(
      "verify",
      [](const Text& result, const Text& catalogue, bool brute_force, const py::object& progress) {
        return RunWatched(
            progress, [&](Watch& watch) { return Verify(result, catalogue, brute_force, watch); });
      },
      py::arg("result"), py::arg("catalogue"), py::arg("brute_force"),
      py::arg("progress") = py::none());
}

}  // namespace
}  // namespace plenum::python

PYBIND11_MODULE(_core, module) {
  module.doc() = "Documents of plenum's contract as text in and out.";
  module.attr("version") = std::string(plenum::api::Version());
  pybind11::register_local_exception_translator(plenum::python::TranslateErrors);
  plenum::python::DefineCatalogue(module);
  plenum::python::DefinePartTests(module);
  plenum::python::DefineComputations(module);
}
