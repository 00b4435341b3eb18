#include "fmu/unit_description.h"

#include <string_view>
#include <vector>

#include "fmu/variables.h"

namespace plenum::fmu {
namespace {

std::string Escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return escaped;
}

// Of the variables of one quantity.
struct Form {
  std::string_view causality, variability, element, description;
};

Form FormOf(Quantity quantity) {
  switch (quantity) {
    case Quantity::kCommand:
      return {"input", "discrete", R"(<Integer start="0" min="-1" max="1"/>)",
              "1 inflate, 0 hold, -1 deflate"};
    case Quantity::kVolume:
      return {"input", "continuous", R"(<Real unit="mL" min="0" start="0"/>)",
              "volume of the actuator, without its tube; 0: by the law of the requirements"};
    case Quantity::kPressure:
      return {"output", "continuous", R"(<Real unit="kPa"/>)", "pressure above ambient"};
    case Quantity::kFlow:
      return {
          "output", "continuous", R"(<Real unit="L/min"/>)",
          "standard flow (ISO 8778) into the actuator, mean of the last step; out of it below 0"};
    case Quantity::kVolumeNow:
      return {"output", "continuous", R"(<Real unit="mL"/>)", "volume without the tube's"};
    case Quantity::kSource:
      return {"output", "continuous", R"(<Real unit="kPa"/>)", "pressure above ambient"};
    case Quantity::kEnergyUsed:
      return {"output", "continuous", R"(<Real unit="Wh"/>)", "by pumps, coils and regulator"};
    case Quantity::kBatteryCharge:
      return {"output", "continuous", R"(<Real unit="1"/>)",
              "share of the usable energy that is left; below 0: more was used"};
    case Quantity::kAirUsed:
      return {"output", "continuous", R"(<Real unit="L"/>)",
              "standard volume (ISO 8778) that the lines took"};
    case Quantity::kAirLeft:
      return {"output", "continuous", R"(<Real unit="1"/>)",
              "share of the gas on board that is left; below 0: more was taken"};
    case Quantity::kCloses:
      break;
  }
  return {"parameter", "fixed", R"(<Boolean start="true"/>)",
          "whether a valve that inflates closes at the operating pressure by itself"};
}

std::string VariableText(const Variable& variable, std::size_t reference, const Unit& unit) {
  const Form form = FormOf(variable.quantity);
  std::string description(form.description);
  if (variable.quantity == Quantity::kCommand && !unit.valves[variable.actuator].holds)
    description = "1 inflate, -1 deflate; this valve cannot hold: 0 leaves it as it is";
  return "    <ScalarVariable name=\"" + Escaped(variable.name) + "\" valueReference=\"" +
         std::to_string(reference) + "\" causality=\"" + std::string(form.causality) +
         "\" variability=\"" + std::string(form.variability) + "\" description=\"" + description +
         "\">" + std::string(form.element) + "</ScalarVariable>\n";
}

constexpr char kUnits[] = R"(  <UnitDefinitions>
    <Unit name="kPa"><BaseUnit kg="1" m="-1" s="-2" factor="1000"/></Unit>
    <Unit name="mL"><BaseUnit m="3" factor="1e-6"/></Unit>
    <Unit name="L"><BaseUnit m="3" factor="1e-3"/></Unit>
    <Unit name="L/min"><BaseUnit m="3" s="-1" factor="1.6666666666666667e-5"/></Unit>
    <Unit name="Wh"><BaseUnit kg="1" m="2" s="-2" factor="3600"/></Unit>
    <Unit name="1"/>
  </UnitDefinitions>
)";

}  // namespace

std::string DescriptionOf(const Unit& unit, const std::string& guid, const std::string& tool) {
  const std::vector<Variable> variables = VariablesOf(unit);
  std::string list, unknowns;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    list += VariableText(variables[i], i, unit);
    if (FormOf(variables[i].quantity).causality == "output")
      unknowns += "      <Unknown index=\"" + std::to_string(i + 1) + "\"/>\n";
  }
  const std::string name = Escaped(unit.name);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<fmiModelDescription fmiVersion=\"2.0\" modelName=\"" +
         name + "\" guid=\"" + guid +
         "\" description=\"pneumatic supply with its actuators\" generationTool=\"" +
         Escaped(tool) +
         "\" variableNamingConvention=\"flat\">\n"
         "  <CoSimulation modelIdentifier=\"" +
         kModelIdentifier +
         "\" canHandleVariableCommunicationStepSize=\"true\" "
         "canNotUseMemoryManagementFunctions=\"true\" canGetAndSetFMUstate=\"true\"/>\n" +
         kUnits +
         "  <DefaultExperiment startTime=\"0\" stopTime=\"10\" stepSize=\"0.002\"/>\n"
         "  <ModelVariables>\n" +
         list +
         "  </ModelVariables>\n"
         "  <ModelStructure>\n    <Outputs>\n" +
         unknowns + "    </Outputs>\n    <InitialUnknowns>\n" + unknowns +
         "    </InitialUnknowns>\n  </ModelStructure>\n</fmiModelDescription>\n";
}

}  // namespace plenum::fmu
