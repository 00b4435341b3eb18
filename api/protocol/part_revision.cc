#include "api/protocol/part_revision.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "api/catalogue/part_document.h"
#include "api/json/words.h"
#include "catalog/fields/fields.h"
#include "catalog/fields/half_width.h"

namespace plenum::api {
namespace {

using Origin = catalog::Provenance;
using Files = std::vector<Provenance::File>;

constexpr double kTwoSided95 = 1.959964;
constexpr const char* kFreeAir = "free_air";

// A number with its standard deviation.
struct Known {
  double value = 0.0, deviation = 0.0;
};

double Round(double value, const char* format) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return std::strtod(text, nullptr);
}
double Digits(double value) { return Round(value, "%.6g"); }

Known Combined(const Known& a, const Known& b) {
  const double weight_a = 1.0 / (a.deviation * a.deviation);
  const double weight_b = 1.0 / (b.deviation * b.deviation);
  const double sum = weight_a + weight_b;
  return {(weight_a * a.value + weight_b * b.value) / sum, 1.0 / std::sqrt(sum)};
}

// How far the number may be from what stands in the catalogue.
double RoomOf(double value, Origin provenance, const std::optional<double>& uncertainty) {
  const double share = provenance == Origin::kMeasured && uncertainty
                           ? kTwoSided95 * *uncertainty
                           : catalog::Tolerance().Of(provenance, uncertainty);
  return share * std::abs(value);
}

std::string Contradiction(double before, double room, const Known& measured,
                          std::string_view provenance) {
  const double apart = std::abs(measured.value - before);
  if (apart <= std::hypot(room, kTwoSided95 * measured.deviation)) return "";
  return "measured " + Decimal(Digits(measured.value)) + " is off " + Decimal(Digits(before)) +
         " (" + std::string(provenance) + ") by more than the uncertainties of both";
}

class Revising {
 public:
  Revising(const catalog::Part& part, const Json& answer, const Files& files, bool anyway)
      : part_(part), answer_(answer), files_(files), anyway_(anyway) {}

  PartRevision Take() {
    told_ = {{"part", part_.id}, {"numbers", Json::array()}, {"refused", Json::array()}};
    for (const Json& reason : answer_.at("measured_refused")) Refuse(reason.get<std::string>());
    RefuseRepeated();
    if (told_["refused"].empty()) TakeNumbers();
    if (told_["refused"].empty() && !any_) Refuse("no number of " + part_.id + " was measured");
    if (told_["refused"].empty()) AddDocuments();
    for (const catalog::FieldError& error : catalog::Validate(part_))
      Refuse(error.field + ": " + error.detail);
    PartRevision revision;
    if (told_["refused"].empty()) revision.part = std::move(part_);
    revision.told = std::move(told_);
    return revision;
  }

 private:
  void Refuse(std::string reason) { told_["refused"].push_back(std::move(reason)); }

  // A recording is no second test of the part.
  void RefuseRepeated() {
    for (const auto& file : files_)
      for (const catalog::Document& document : part_.documents)
        if (document.sha256 == file.sha256)
          Refuse(file.name + " is among the documents of " + part_.id +
                 ": its numbers were saved before");
  }

  void TakeNumbers() {
    std::vector<const Json*> curve;
    for (const Json& row : answer_.at("measured")) {
      if (row.at("part") != part_.id) continue;
      if (row.at("field") == kFreeAir)
        curve.push_back(&row);
      else if (row.at("refused").is_null())
        TakeNumber(row);
    }
    if (!curve.empty()) TakeCurve(curve);
  }

  std::string Source() const {
    std::string names;
    for (const auto& file : files_) names += (names.empty() ? "" : ", ") + file.name;
    return "fitted to " + Clip(names, 120);
  }

  void Tell(const std::string& field, double before, Origin provenance,
            const std::optional<double>& before_uncertainty, const Known& measured,
            const Known& kept, bool combined, const std::string& contradiction) {
    any_ = true;
    told_["numbers"].push_back(
        {{"field", field},
         {"before", Number(before)},
         {"before_provenance", catalog::Name(provenance)},
         {"before_uncertainty", before_uncertainty ? Number(*before_uncertainty) : Json(nullptr)},
         {"measured", Number(Digits(measured.value))},
         {"uncertainty", Number(kept.deviation / kept.value)},
         {"value", Number(Digits(kept.value))},
         {"combined", combined},
         {"contradiction", contradiction.empty() ? Json(nullptr) : Json(contradiction)}});
    if (!contradiction.empty() && !anyway_) Refuse(field + ": " + contradiction);
  }

  void TakeNumber(const Json& row) {
    const auto field = row.at("field").get<std::string>();
    const auto stored = part_.numbers.find(field);
    if (stored == part_.numbers.end()) return Refuse(part_.id + " has no " + field);
    catalog::Number& number = stored->second;
    const double value = row.at("fitted").get<double>();
    const Known measured{value, value * row.at("uncertainty").get<double>()};
    const std::string contradiction =
        Contradiction(number.value, RoomOf(number.value, number.provenance, number.uncertainty),
                      measured, catalog::Name(number.provenance));
    const bool combines = contradiction.empty() && number.provenance == Origin::kMeasured &&
                          number.uncertainty && *number.uncertainty > 0.0;
    const Known kept = combines
                           ? Combined({number.value, number.value * *number.uncertainty}, measured)
                           : measured;
    Tell(field, number.value, number.provenance, number.uncertainty, measured, kept, combines,
         contradiction);
    number = {.value = Digits(kept.value),
              .provenance = Origin::kMeasured,
              .source = Source(),
              .uncertainty = Round(kept.deviation / kept.value, "%.3g")};
  }

  void TakeCurve(const std::vector<const Json*>& rows) {
    if (!part_.curve || part_.curve->points.size() != rows.size())
      return Refuse("the curve of " + part_.id + " has other points than the rig's");
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (const Json* row = rows[i];
          !row->at("refused").is_null() && !Stays(part_.curve->points[i], *row))
        return Refuse("free_air at " + Decimal(row->at("pressure_kpa_gauge").get<double>()) +
                      " kPa " + row->at("refused").get<std::string>());
    catalog::Curve& curve = *part_.curve;
    const double share = LargestShare(rows);
    const bool combines = curve.free_air_provenance == Origin::kMeasured &&
                          curve.free_air_uncertainty && *curve.free_air_uncertainty > 0.0;
    const double before_share = combines ? *curve.free_air_uncertainty : 0.0;
    std::vector<catalog::CurvePoint> points = curve.points;
    bool contradicted = false;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      double& flow = points[i].free_air_l_per_min;
      if (Stays(points[i], *rows[i])) continue;
      const double value = rows[i]->at("fitted").get<double>();
      const double deviation = rows[i]->at("uncertainty").is_null()
                                   ? 0.0
                                   : value * rows[i]->at("uncertainty").get<double>();
      const Known measured{value, deviation};
      const std::string contradiction =
          Contradiction(flow,
                        RoomOf(std::max(flow, kCurveShare * points.front().free_air_l_per_min),
                               curve.free_air_provenance, curve.free_air_uncertainty),
                        measured, catalog::Name(curve.free_air_provenance));
      const bool both = combines && contradiction.empty() && flow > 0.0 && value > 0.0;
      const Known kept =
          both ? Combined({flow, flow * before_share}, {value, value * share}) : measured;
      if (value > 0.0)
        Tell("free_air at " + Decimal(points[i].pressure_kpa_gauge) + " kPa", flow,
             curve.free_air_provenance, curve.free_air_uncertainty, measured, kept, both,
             contradiction);
      contradicted = contradicted || !contradiction.empty();
      flow = Digits(kept.value);
    }
    curve.points = std::move(points);
    curve.free_air_uncertainty =
        Round(combines && !contradicted ? 1.0 / std::hypot(1.0 / before_share, 1.0 / share) : share,
              "%.3g");
    curve.free_air_provenance = Origin::kMeasured;
    curve.free_air_source = Source();
  }

  // The end of the table, where the pump may well deliver nothing: a test that ends before its
  // stall tells little of it.
  static bool Stays(const catalog::CurvePoint& point, const Json& row) {
    return point.free_air_l_per_min == 0.0 &&
           (!row.at("refused").is_null() || row.at("interval_95")[0].get<double>() <= 0.0);
  }

  static double LargestShare(const std::vector<const Json*>& rows) {
    double most = 0.0, share = 0.0;
    for (const Json* row : rows) most = std::max(most, row->at("fitted").get<double>());
    for (const Json* row : rows)
      if (row->at("fitted").get<double>() >= kCurveShare * most &&
          row->at("uncertainty").is_number())
        share = std::max(share, row->at("uncertainty").get<double>());
    return share;
  }

  void AddDocuments() {
    for (const auto& file : files_) part_.documents.push_back({file.name, file.sha256});
    part_.origin = "user";  // new seed rows do not take it back
  }

  catalog::Part part_;
  const Json& answer_;
  const Files& files_;
  bool anyway_;
  bool any_ = false;
  Json told_;
};

}  // namespace

PartRevision RevisePart(const catalog::Part& part, const Json& answer,
                        const std::vector<Provenance::File>& files, bool anyway) {
  return Revising(part, answer, files, anyway).Take();
}

std::string WhyNotMeasured(const calibration::Dataset& dataset, const std::string& id) {
  if (id.empty()) return "";
  std::vector<std::string> ids;
  for (const calibration::MeasuredNumber& number : dataset.measured) {
    if (number.part == id) return "";
    if (std::find(ids.begin(), ids.end(), number.part) == ids.end()) ids.push_back(number.part);
  }
  return "must be a part of which the rig says what to measure" +
         (ids.empty() ? ", and it says so of none" : ": " + OneOf(ids)) + "; not " + Quoted(id);
}

Json SavePart(catalog::Store& store, const std::string& id, const Json& answer,
              const std::vector<Provenance::File>& files, bool anyway,
              const catalog::Signature& by) {
  const std::optional<catalog::Part> stored = store.Get(id);
  if (!stored)
    return {{"part", id},
            {"numbers", Json::array()},
            {"refused", Json::array({"the catalogue has no part " + Quoted(id)})},
            {"revision", nullptr}};
  PartRevision revised = RevisePart(*stored, answer, files, anyway);
  Json told = std::move(revised.told);
  told["revision"] = nullptr;
  if (!revised.part) return told;
  const catalog::WriteResult written =
      store.Replace(*revised.part, by, [&](const catalog::Part& now) { return now == *stored; });
  if (written.status == catalog::WriteStatus::kDone)
    told["revision"] = RenderRevisionName(written.revision);
  else
    told["refused"].push_back("the part was changed meanwhile: diagnose again");
  return told;
}

}  // namespace plenum::api
