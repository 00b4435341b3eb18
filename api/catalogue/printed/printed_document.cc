#include "api/catalogue/printed/printed_document.h"

#include <cmath>
#include <string>

#include "api/json/json.h"
#include "api/json/remarks.h"
#include "api/json/words.h"
#include "catalog/fields/laws/printed_part.h"
#include "catalog/units/printed_flow.h"
#include "catalog/units/quantity.h"

namespace plenum::api {
namespace {

constexpr char kBody[] = "body_volume_ml", kCurrent[] = "current_max_a", kCurve[] = "curve";
constexpr char kCapacity[] = "capacity_ah", kVoltage[] = "nominal_voltage_v";
constexpr Range kSide{catalog::kBodySideMinMm, catalog::kBodySideMaxMm};
constexpr Range kFreeFlow{1e-6, 1e6}, kPumpCurrent{1e-6, 1e3}, kCRate{1e-3, 1e3};
constexpr Range kEnergy{1e-3, 1e6};

const catalog::NumberField* FieldOf(const catalog::Family& family, std::string_view name) {
  for (const catalog::NumberField& field : family.numbers)
    if (field.name == name) return &field;
  return nullptr;
}

void NoteFormula(Reader& reader, const std::string& name, const Json& value,
                 const std::string& unit, const std::string& formula) {
  if (auto* recorder = RemarkRecorder::Current())
    recorder->Understood("/" + name, {{"name", name},
                                      {"given", *reader.Raw(name)},
                                      {"value", value},
                                      {"unit", unit},
                                      {"formula", formula}});
}

void TakeDerived(Reader& reader, const catalog::NumberField& field,
                 const catalog::PrintedNumber& printed, catalog::Part& part) {
  const std::string name(field.name);
  const Range range{field.min, field.max};
  if (!range.Contains(printed.value))
    reader.Fail(name, "comes to " + Decimal(printed.value) + " (" + printed.formula +
                          "); must be " + range.Text());
  const std::string unit =
      catalog::IsConductance(name) ? "dm3/(s·bar)" : std::string(catalog::UnitOf(name));
  NoteFormula(reader, name, printed.value, unit, printed.formula);
  part.numbers[name] = {printed.value, catalog::Provenance::kDerived, printed.formula};
}

// What is printed in place of a conductance, as an object or a text; none: a number or nothing.
std::optional<catalog::PrintedFlow> ReadFlow(Reader& reader, const std::string& name) {
  const Json& value = *reader.Raw(name);
  catalog::PrintedFlow printed;
  if (value.is_string()) {
    const std::string& text = value.get_ref<const std::string&>();
    if (!catalog::IsPrintedFlow(text)) return std::nullopt;
    if (std::string error = catalog::ReadPrintedFlow(text, printed); !error.empty())
      reader.Fail(name, std::move(error));
    return printed;
  }
  if (!value.is_object()) return std::nullopt;
  Reader object = reader.Object(name);
  std::vector<std::string> names, given;
  for (const catalog::FlowNotationSpec& spec : catalog::FlowNotations()) {
    names.emplace_back(spec.field);
    if (!object.Has(spec.field)) continue;
    given.emplace_back(spec.field);
    printed.notation = spec.notation;
    printed.value = object.Number(spec.field, {spec.min, spec.max});
  }
  if (given.size() != 1)
    object.FailHere("must hold one of " + OneOf(names) + ", not " + std::to_string(given.size()));
  if (printed.notation == catalog::FlowNotation::kQn && object.Has("at"))
    if (std::string error = catalog::ReadFlowPressures(object.Text("at"), printed); !error.empty())
      object.Fail("at", std::move(error));
  object.Finish();
  return printed;
}

// The conductances that are given as they are printed: derived, with formula and source.
void DeriveFlows(Reader& reader, const catalog::Family& family, catalog::Part& part) {
  for (const catalog::NumberField& field : family.numbers) {
    const std::string name(field.name);
    if (!catalog::IsConductance(name) || !reader.Has(name)) continue;
    const std::size_t errors_before = reader.errors().size();
    const auto printed = ReadFlow(reader, name);
    if (!printed || reader.errors().size() > errors_before) continue;
    const auto ratio = part.numbers.find(catalog::CriticalRatioOf(name));
    const catalog::DerivedFlow derived = catalog::ConductanceOf(
        *printed, ratio == part.numbers.end() || std::isnan(ratio->second.value)
                      ? std::nullopt
                      : std::optional(ratio->second.value));
    TakeDerived(reader, field, {derived.conductance_dm3_per_s_bar, derived.formula}, part);
  }
}

// {"length_mm": 70, "width_mm": 30, "height_mm": 50}, {"diameter_mm": 18.5, "length_mm": 65}, or a
// text with ×.
void DeriveBody(Reader& reader, const catalog::Family& family, catalog::Part& part) {
  const Json& value = *reader.Raw(kBody);
  const std::size_t errors_before = reader.errors().size();
  catalog::PrintedBody body;
  if (value.is_string()) {
    std::string error = catalog::ReadPrintedBody(value.get_ref<const std::string&>(), body);
    if (!error.empty()) reader.Fail(kBody, std::move(error));
  } else {
    Reader object = reader.Object(kBody);
    const bool is_round = object.Has("diameter_mm");
    body.length_mm = object.Number("length_mm", kSide);
    if (is_round) {
      body.diameter_mm = object.Number("diameter_mm", kSide);
    } else {
      body.width_mm = object.Number("width_mm", kSide);
      body.height_mm = object.Number("height_mm", kSide);
    }
    object.Finish();
  }
  if (reader.errors().size() == errors_before)
    TakeDerived(reader, *FieldOf(family, kBody), catalog::BodyVolumeOf(body), part);
}

// A field that is given as one printed number: {"c_rate": 25} or "25C", {"energy_wh": 19.2} or
// "19.2 Wh"; what it takes beside that, and what says so where that is lacking.
struct OnePrinted {
  const char* field;
  const char* member;
  Range range;
  std::optional<double> (*of_text)(std::string_view);
  const char* beside;
  const char* lacking;
  catalog::PrintedNumber (*derive)(double printed, double beside);
};
constexpr OnePrinted kCapacityOfEnergy{kCapacity,
                                       "energy_wh",
                                       kEnergy,
                                       catalog::PrintedEnergy,
                                       kVoltage,
                                       "an energy needs nominal_voltage_v",
                                       catalog::CapacityOfEnergy};
constexpr OnePrinted kCurrentOfRate{kCurrent,
                                    "c_rate",
                                    kCRate,
                                    catalog::PrintedCRate,
                                    kCapacity,
                                    "a C-rate needs capacity_ah",
                                    catalog::CurrentOfCRate};

void DeriveFromOne(Reader& reader, const catalog::Family& family, const OnePrinted& one,
                   catalog::Part& part) {
  const Json& value = *reader.Raw(one.field);
  const std::size_t errors_before = reader.errors().size();
  double printed = 0;
  if (value.is_string()) {
    printed = one.of_text(value.get_ref<const std::string&>()).value();
  } else {
    Reader object = reader.Object(one.field);
    printed = object.Number(one.member, one.range);
    object.Finish();
  }
  const auto beside = part.numbers.find(one.beside);
  if (beside == part.numbers.end() || !(beside->second.value > 0))
    return reader.Fail(one.field, one.lacking);
  if (reader.errors().size() == errors_before)
    TakeDerived(reader, *FieldOf(family, one.field), one.derive(printed, beside->second.value),
                part);
}

}  // namespace

bool IsPrinted(Reader& reader, const std::string& name) {
  const Json& value = *reader.Raw(name);
  const bool has_notation = catalog::IsConductance(name) || name == kBody || name == kCurrent ||
                            name == kCapacity || name == kCurve;
  if (!has_notation || value.is_object()) return has_notation;
  if (!value.is_string()) return false;
  const std::string& text = value.get_ref<const std::string&>();
  if (name == kBody) return catalog::IsPrintedBody(text);
  if (name == kCurrent) return catalog::PrintedCRate(text).has_value();
  if (name == kCapacity) return catalog::PrintedEnergy(text).has_value();
  return name == kCurve ? catalog::IsPrintedPump(text) : catalog::IsPrintedFlow(text);
}

void DerivePrinted(Reader& reader, const catalog::Family& family, catalog::Part& part) {
  DeriveFlows(reader, family, part);
  const auto is_given = [&](const char* name) {
    return FieldOf(family, name) != nullptr && reader.Has(name) && IsPrinted(reader, name);
  };
  if (is_given(kBody)) DeriveBody(reader, family, part);
  // A C-rate may be one of a capacity that is itself printed as an energy.
  for (const OnePrinted& one : {kCapacityOfEnergy, kCurrentOfRate})
    if (is_given(one.field)) DeriveFromOne(reader, family, one, part);
}

void DerivePrintedCurve(Reader& reader, catalog::Part& part) {
  const Json& value = *reader.Raw(kCurve);
  const std::size_t errors_before = reader.errors().size();
  catalog::PrintedPump pump;
  if (value.is_string()) {
    std::string error = catalog::ReadPrintedPump(value.get_ref<const std::string&>(), pump);
    if (!error.empty()) reader.Fail(kCurve, std::move(error));
  } else {
    Reader object = reader.Object(kCurve);
    pump.free_flow_l_per_min = object.Number("free_flow_l_per_min", kFreeFlow);
    pump.current_a = object.OptionalNumber("current_a", kPumpCurrent);
    object.Finish();
  }
  if (reader.errors().size() > errors_before) return;
  if (std::string error = catalog::DeriveCurve(pump, "", part); !error.empty())
    return reader.Fail(kCurve, std::move(error));
  if (part.curve)
    NoteFormula(reader, kCurve, part.curve->points.size(), "points of the curve",
                part.curve->free_air_source + "; " + part.curve->current_source);
}

}  // namespace plenum::api
