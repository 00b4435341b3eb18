// The binary of every unit: what a robot's simulator calls. It reads the unit out of the resources
// of its file.
#include "fmu/fmi2.h"

#include <cmath>
#include <exception>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "fmu/unit_run.h"
#include "fmu/unit_text.h"
#include "fmu/variables.h"

namespace plenum::fmu {
namespace {

constexpr double kMlPerM3 = 1e6, kLPerM3 = 1e3, kLPerMin = 6e4, kPaPerKpa = 1e3, kJPerWh = 3600.0;

struct Instance {
  Unit unit;
  std::vector<Variable> variables;
  UnitRun run;
  std::string name;
  fmi2CallbackFunctions callbacks;
  bool logs;
  bool runs = false;  // initialised

  Instance(Unit given, const char* instance, const fmi2CallbackFunctions& to, bool log)
      : unit(std::move(given)),
        variables(VariablesOf(unit)),
        run(unit),
        name(instance == nullptr ? "" : instance),
        callbacks(to),
        logs(log) {}
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
};

void Log(const fmi2CallbackFunctions& to, const std::string& instance, const std::string& text) {
  if (to.logger != nullptr)
    to.logger(to.componentEnvironment, instance.c_str(), fmi2Error, "error", "%s", text.c_str());
}

fmi2Status Refuse(const Instance& of, const std::string& text) {
  Log(of.callbacks, of.name, text);
  return fmi2Error;
}

int HexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const char low = static_cast<char>(c | 0x20);
  return low >= 'a' && low <= 'f' ? low - 'a' + 10 : -1;
}

// "file:///a%20b", "file:/a b" or "/a b" as a path.
std::string PathOf(std::string_view uri) {
  if (uri.starts_with("file:")) uri.remove_prefix(5);
  if (uri.starts_with("//")) uri.remove_prefix(std::min(uri.find('/', 2), uri.size()));
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool coded = uri[i] == '%' && i + 2 < uri.size() && HexDigit(uri[i + 1]) >= 0 &&
                       HexDigit(uri[i + 2]) >= 0;
    path += coded ? static_cast<char>(16 * HexDigit(uri[i + 1]) + HexDigit(uri[i + 2])) : uri[i];
    if (coded) i += 2;
  }
  return path;
}

double RealOf(const Instance& of, const Variable& variable) {
  const UnitRun& run = of.run;
  const double ambient_pa = of.unit.rig.ambient.pressure_pa;
  switch (variable.quantity) {
    case Quantity::kVolume:
      return kMlPerM3 * run.inputs[variable.actuator].volume_m3;
    case Quantity::kPressure:
      return (run.outputs()[variable.actuator].pressure_pa - ambient_pa) / kPaPerKpa;
    case Quantity::kFlow:
      return kLPerMin * run.outputs()[variable.actuator].flow_m3_per_s;
    case Quantity::kVolumeNow:
      return kMlPerM3 * run.outputs()[variable.actuator].volume_m3;
    case Quantity::kSource:
      return (run.source_pressure_pa() - ambient_pa) / kPaPerKpa;
    case Quantity::kEnergyUsed:
      return run.energy_used_j() / kJPerWh;
    case Quantity::kBatteryCharge:
      return 1.0 - run.energy_used_j() / of.unit.energy_available_j;
    case Quantity::kAirUsed:
      return kLPerM3 * run.air_used_m3();
    case Quantity::kAirLeft:
      return 1.0 - run.air_used_m3() / of.unit.air_available_m3;
    case Quantity::kCommand:
    case Quantity::kCloses:
      break;
  }
  return 0.0;
}

// Calls `take(variable, i)` with each that is asked for and of one of the quantities that `fits`
// names; it says what is wrong, if anything is.
template <typename Fits, typename Take>
fmi2Status ForEach(fmi2Component component, const fmi2ValueReference* references, std::size_t count,
                   const Fits& fits, const Take& take) {
  Instance& instance = *static_cast<Instance*>(component);
  for (std::size_t i = 0; i < count; ++i) {
    if (references[i] >= instance.variables.size() ||
        !fits(instance.variables[references[i]].quantity))
      return Refuse(instance, "there is no variable of this type with the value reference " +
                                  std::to_string(references[i]));
    const Variable& variable = instance.variables[references[i]];
    const std::string wrong = take(instance, variable, i);
    if (!wrong.empty()) return Refuse(instance, variable.name + " " + wrong);
  }
  return fmi2OK;
}

bool IsCommand(Quantity quantity) { return quantity == Quantity::kCommand; }
bool IsFlag(Quantity quantity) { return quantity == Quantity::kCloses; }
bool IsReal(Quantity quantity) { return !IsCommand(quantity) && !IsFlag(quantity); }
bool IsVolume(Quantity quantity) { return quantity == Quantity::kVolume; }

// No exception may leave the binary.
template <typename Action>
fmi2Status Guarded(fmi2Component component, const Action& action) {
  Instance& instance = *static_cast<Instance*>(component);
  try {
    return action(instance);
  } catch (const std::exception& error) {
    Log(instance.callbacks, instance.name, error.what());
    return fmi2Fatal;
  }
}

std::unique_ptr<Instance> Load(fmi2String name, fmi2String guid, fmi2String resources,
                               const fmi2CallbackFunctions& callbacks, bool log) {
  std::ifstream file(PathOf(resources == nullptr ? "" : resources) + "/unit.txt", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string instance = name == nullptr ? "" : name;
  if (guid == nullptr || GuidOf(text) != guid) {
    Log(callbacks, instance,
        "resources/unit.txt is not there, or not that of modelDescription.xml");
    return nullptr;
  }
  std::optional<Unit> unit = ReadUnit(text);
  if (!unit) {
    Log(callbacks, instance, "resources/unit.txt is of another version");
    return nullptr;
  }
  return std::make_unique<Instance>(*std::move(unit), name, callbacks, log);
}

}  // namespace
}  // namespace plenum::fmu

using plenum::fmu::ForEach;
using plenum::fmu::Guarded;
using plenum::fmu::Instance;
using plenum::fmu::Quantity;
using plenum::fmu::Refuse;
using plenum::fmu::UnitRun;
using plenum::fmu::Variable;

const char* fmi2GetTypesPlatform() { return "default"; }
const char* fmi2GetVersion() { return "2.0"; }

fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean on, std::size_t,
                               const fmi2String*) {
  static_cast<Instance*>(component)->logs = on != 0;
  return fmi2OK;
}

fmi2Component fmi2Instantiate(fmi2String instance, fmi2Type type, fmi2String guid,
                              fmi2String resources, const fmi2CallbackFunctions* callbacks,
                              fmi2Boolean, fmi2Boolean log) {
  const fmi2CallbackFunctions silent{};
  const fmi2CallbackFunctions& to = callbacks == nullptr ? silent : *callbacks;
  const std::string name = instance == nullptr ? "" : instance;
  try {
    if (type == fmi2CoSimulation)
      return plenum::fmu::Load(instance, guid, resources, to, log != 0).release();
    plenum::fmu::Log(to, name, "this unit is for co-simulation");
  } catch (const std::exception& error) {
    plenum::fmu::Log(to, name, error.what());
  }
  return nullptr;
}

void fmi2FreeInstance(fmi2Component component) { delete static_cast<Instance*>(component); }

fmi2Status fmi2SetupExperiment(fmi2Component, fmi2Boolean, fmi2Real, fmi2Real, fmi2Boolean,
                               fmi2Real) {
  return fmi2OK;
}
fmi2Status fmi2EnterInitializationMode(fmi2Component) { return fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component component) {
  static_cast<Instance*>(component)->runs = true;
  return fmi2OK;
}
fmi2Status fmi2Terminate(fmi2Component) { return fmi2OK; }
fmi2Status fmi2Reset(fmi2Component component) {
  return Guarded(component, [](Instance& instance) {
    instance.run = UnitRun(instance.unit);
    instance.runs = false;
    return fmi2OK;
  });
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference* references,
                       std::size_t count, fmi2Real* values) {
  return ForEach(component, references, count, plenum::fmu::IsReal,
                 [values](const Instance& of, const Variable& variable, std::size_t i) {
                   values[i] = RealOf(of, variable);
                   return std::string();
                 });
}

fmi2Status fmi2GetInteger(fmi2Component component, const fmi2ValueReference* references,
                          std::size_t count, fmi2Integer* values) {
  return ForEach(component, references, count, plenum::fmu::IsCommand,
                 [values](const Instance& of, const Variable& variable, std::size_t i) {
                   values[i] = of.run.inputs[variable.actuator].command;
                   return std::string();
                 });
}

fmi2Status fmi2GetBoolean(fmi2Component component, const fmi2ValueReference* references,
                          std::size_t count, fmi2Boolean* values) {
  return ForEach(component, references, count, plenum::fmu::IsFlag,
                 [values](const Instance& of, const Variable&, std::size_t i) {
                   values[i] = of.run.close_at_operating ? 1 : 0;
                   return std::string();
                 });
}

fmi2Status fmi2GetString(fmi2Component component, const fmi2ValueReference*, std::size_t count,
                         fmi2String*) {
  return count == 0 ? fmi2OK : Refuse(*static_cast<Instance*>(component), "no variable is a text");
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference* references,
                       std::size_t count, const fmi2Real* values) {
  return ForEach(component, references, count, plenum::fmu::IsVolume,
                 [values](Instance& of, const Variable& variable, std::size_t i) -> std::string {
                   constexpr double kMlMax = 1e6;
                   if (!(values[i] >= 0.0 && values[i] <= kMlMax))
                     return "must be between 0 and 1000000 mL, is " + std::to_string(values[i]);
                   of.run.inputs[variable.actuator].volume_m3 = values[i] / plenum::fmu::kMlPerM3;
                   return "";
                 });
}

fmi2Status fmi2SetInteger(fmi2Component component, const fmi2ValueReference* references,
                          std::size_t count, const fmi2Integer* values) {
  return ForEach(component, references, count, plenum::fmu::IsCommand,
                 [values](Instance& of, const Variable& variable, std::size_t i) -> std::string {
                   if (values[i] < -1 || values[i] > 1)
                     return "must be -1, 0 or 1, is " + std::to_string(values[i]);
                   of.run.inputs[variable.actuator].command = values[i];
                   return "";
                 });
}

fmi2Status fmi2SetBoolean(fmi2Component component, const fmi2ValueReference* references,
                          std::size_t count, const fmi2Boolean* values) {
  return ForEach(component, references, count, plenum::fmu::IsFlag,
                 [values](Instance& of, const Variable&, std::size_t i) -> std::string {
                   if (of.runs) return "cannot be changed once the simulation runs";
                   of.run.close_at_operating = values[i] != 0;
                   return "";
                 });
}

fmi2Status fmi2SetString(fmi2Component component, const fmi2ValueReference*, std::size_t count,
                         const fmi2String*) {
  return count == 0 ? fmi2OK : Refuse(*static_cast<Instance*>(component), "no variable is a text");
}

fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return Guarded(component, [state](const Instance& instance) {
    if (*state == nullptr)
      *state = new UnitRun(instance.run);
    else
      *static_cast<UnitRun*>(*state) = instance.run;
    return fmi2OK;
  });
}

fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state) {
  return Guarded(component, [state](Instance& instance) {
    instance.run = *static_cast<const UnitRun*>(state);
    return fmi2OK;
  });
}

fmi2Status fmi2FreeFMUstate(fmi2Component, fmi2FMUstate* state) {
  if (state == nullptr) return fmi2OK;
  delete static_cast<UnitRun*>(*state);
  *state = nullptr;
  return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real, fmi2Real step, fmi2Boolean) {
  return Guarded(component, [step](Instance& instance) {
    if (!instance.runs) return Refuse(instance, "is not initialised");
    if (!(step > 0.0) || !std::isfinite(step))
      return Refuse(instance, "a step must be above 0 s, is " + std::to_string(step));
    return instance.run.Step(step) ? fmi2OK : Refuse(instance, instance.run.detail());
  });
}

fmi2Status fmi2CancelStep(fmi2Component) { return fmi2Error; }
fmi2Status fmi2SerializedFMUstateSize(fmi2Component, fmi2FMUstate, std::size_t*) {
  return fmi2Error;
}
fmi2Status fmi2SerializeFMUstate(fmi2Component, fmi2FMUstate, fmi2Byte*, std::size_t) {
  return fmi2Error;
}
fmi2Status fmi2DeSerializeFMUstate(fmi2Component, const fmi2Byte*, std::size_t, fmi2FMUstate*) {
  return fmi2Error;
}
fmi2Status fmi2GetDirectionalDerivative(fmi2Component, const fmi2ValueReference*, std::size_t,
                                        const fmi2ValueReference*, std::size_t, const fmi2Real*,
                                        fmi2Real*) {
  return fmi2Error;
}
fmi2Status fmi2SetRealInputDerivatives(fmi2Component, const fmi2ValueReference*, std::size_t,
                                       const fmi2Integer*, const fmi2Real*) {
  return fmi2Error;
}
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component, const fmi2ValueReference*, std::size_t,
                                        const fmi2Integer*, fmi2Real*) {
  return fmi2Error;
}
fmi2Status fmi2GetStatus(fmi2Component, fmi2StatusKind, fmi2Status*) { return fmi2Discard; }
fmi2Status fmi2GetRealStatus(fmi2Component, fmi2StatusKind, fmi2Real*) { return fmi2Discard; }
fmi2Status fmi2GetIntegerStatus(fmi2Component, fmi2StatusKind, fmi2Integer*) { return fmi2Discard; }
fmi2Status fmi2GetBooleanStatus(fmi2Component, fmi2StatusKind, fmi2Boolean*) { return fmi2Discard; }
fmi2Status fmi2GetStringStatus(fmi2Component, fmi2StatusKind, fmi2String*) { return fmi2Discard; }
