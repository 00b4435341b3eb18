#include "api/protocol/part_revision.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "api/catalogue/part_document.h"
#include "api/json/words.h"
#include "api/protocol/piece_tests.h"
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

bool IsOff(double before, double room, const Known& measured) {
  return std::abs(measured.value - before) > std::hypot(room, kTwoSided95 * measured.deviation);
}

std::string Contradiction(double before, const Known& measured, std::string_view of) {
  return "measured " + Decimal(Digits(measured.value)) + " is off " + Decimal(Digits(before)) +
         " (" + std::string(of) + ") by more than the uncertainties of both";
}

std::string OfEstimate(double before, const Known& measured) {
  const double share = before / measured.value - 1.0;
  return "the estimate " + Decimal(Digits(before)) + " was " +
         Decimal(Round(100.0 * std::abs(share), "%.2g")) + " % too " +
         (share < 0.0 ? "low" : "high");
}

// What the catalogue has of a number, or of a curve at its points.
struct Stored {
  std::vector<double> values;
  Origin provenance = Origin::kEstimated;
  std::optional<double> uncertainty;
  std::string source;
};

// The tests of pieces behind it; none where it was not measured with an uncertainty. What was
// written by hand since is a test of a piece without a name.
std::vector<PieceTest> TestsBehind(const Stored& stored) {
  if (stored.provenance != Origin::kMeasured || !(stored.uncertainty.value_or(0.0) > 0.0))
    return {};
  constexpr double kSame = 1e-4;
  std::vector<PieceTest> pieces = PiecesOf(stored.source);
  if (!pieces.empty() && pieces.front().values.size() == stored.values.size()) {
    const std::vector<double> mean = OfType(pieces).values;
    const bool same = std::equal(
        mean.begin(), mean.end(), stored.values.begin(),
        [](double one, double other) { return std::abs(one - other) <= kSame * std::abs(other); });
    if (same) return pieces;
  }
  return {{"", stored.values, *stored.uncertainty}};
}

// A new test beside what the catalogue has.
class NewTest {
 public:
  NewTest(Stored stored, PieceTest test)
      : stored_(std::move(stored)), test_(std::move(test)), pieces_(TestsBehind(stored_)) {
    own_ = std::find_if(pieces_.begin(), pieces_.end(),
                        [&](const PieceTest& one) { return one.piece == test_.piece; });
  }

  // What the test says of one point against what is known of its piece, or of the type: off it, in
  // words. `least` is the least that its room is a share of.
  std::optional<std::string> OffAt(std::size_t at, const Known& measured, double least) const {
    if (own_ != pieces_.end()) {
      const double before = own_->values[at];
      const double room = kTwoSided95 * own_->uncertainty * std::max(before, least);
      if (!IsOff(before, room, measured)) return {};
      return Contradiction(before, measured, "measured");
    }
    if (!pieces_.empty()) return {};  // another piece: what they differ in is their spread
    const double before = stored_.values[at];
    const double share = catalog::Tolerance().Of(stored_.provenance, stored_.uncertainty);
    if (!IsOff(before, share * std::max(before, least), measured)) return {};
    if (stored_.provenance == Origin::kEstimated) return OfEstimate(before, measured);
    return Contradiction(before, measured, catalog::Name(stored_.provenance));
  }

  bool OfAnEstimate() const { return stored_.provenance == Origin::kEstimated; }
  bool Combines(bool contradicted) const { return own_ != pieces_.end() && !contradicted; }

  // All pieces with the new test; one that contradicts takes the place of those of its piece.
  std::vector<PieceTest> Pieces(bool contradicted) const {
    std::vector<PieceTest> pieces = pieces_;
    if (own_ == pieces_.end())
      pieces.push_back(test_);
    else
      pieces[static_cast<std::size_t>(own_ - pieces_.begin())] =
          contradicted ? test_ : Combined(*own_, test_);
    return pieces;
  }

 private:
  Stored stored_;
  PieceTest test_;
  std::vector<PieceTest> pieces_;
  std::vector<PieceTest>::iterator own_;
};

class Revising {
 public:
  Revising(const catalog::Part& part, const Json& answer, const Files& files, bool anyway,
           std::string specimen)
      : part_(part),
        answer_(answer),
        files_(files),
        anyway_(anyway),
        specimen_(std::move(specimen)) {}

  PartRevision Take() {
    told_ = {{"part", part_.id},
             {"specimen", specimen_.empty() ? Json(nullptr) : Json(specimen_)},
             {"numbers", Json::array()},
             {"refused", Json::array()}};
    for (const Json& reason : answer_.at("measured_refused")) Block(reason.get<std::string>());
    repeated_ = Repeated();
    if (!blocked_) TakeNumbers();
    if (!blocked_ && !written_) RefuseEmpty();
    if (written_) AddDocuments();
    for (const catalog::FieldError& error : catalog::Validate(part_))
      Block(error.field + ": " + error.detail);
    PartRevision revision;
    if (!blocked_ && written_) revision.part = std::move(part_);
    revision.told = std::move(told_);
    return revision;
  }

 private:
  void Refuse(std::string reason) { told_["refused"].push_back(std::move(reason)); }
  // Against writing any number.
  void Block(std::string reason) {
    blocked_ = true;
    Refuse(std::move(reason));
  }

  bool IsDocument(const Provenance::File& file) const {
    return std::any_of(
        part_.documents.begin(), part_.documents.end(),
        [&](const catalog::Document& document) { return document.sha256 == file.sha256; });
  }
  // A recording is no second test of the part: of it only what was not written may be.
  bool Repeated() const {
    return std::any_of(files_.begin(), files_.end(),
                       [this](const auto& file) { return IsDocument(file); });
  }

  void RefuseEmpty() {
    if (!told_["numbers"].empty()) return;  // each says why
    if (!repeated_) return Refuse("no number of " + part_.id + " was measured");
    for (const auto& file : files_)
      if (IsDocument(file))
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

  std::string Source(const std::vector<PieceTest>& pieces) const {
    std::string names;
    for (const auto& file : files_) names += (names.empty() ? "" : ", ") + file.name;
    const std::string source = answer_.contains("by_hand")
                                   ? Clip(answer_.at("by_hand").get<std::string>(), 120)
                                   : "fitted to " + Clip(names, 120);
    const bool nameless = pieces.size() == 1u && pieces.front().piece.empty();
    return nameless ? source : WithPieces(source, pieces);
  }

  void TakeNumber(const Json& row) {
    const auto field = row.at("field").get<std::string>();
    const auto stored = part_.numbers.find(field);
    if (stored == part_.numbers.end()) return Block(part_.id + " has no " + field);
    catalog::Number& number = stored->second;
    const double value = row.at("fitted").get<double>();
    const double share = row.at("uncertainty").get<double>();
    const Known measured{value, value * share};
    const NewTest test({{number.value}, number.provenance, number.uncertainty, number.source},
                       {specimen_, {value}, share});
    const std::optional<std::string> off = test.OffAt(0, measured, 0.0);
    const bool contradicted = off && !test.OfAnEstimate();
    if (repeated_ && !contradicted) return;
    const std::vector<PieceTest> pieces = test.Pieces(contradicted);
    const TypeNumber type = OfType(pieces);
    Json told = {{"field", field},
                 {"before", Number(number.value)},
                 {"before_provenance", catalog::Name(number.provenance)},
                 {"before_uncertainty", NumberOrNull(number.uncertainty)},
                 {"measured", Number(Digits(value))},
                 {"uncertainty", Number(type.uncertainty)},
                 {"value", Number(Digits(type.values.front()))},
                 {"combined", test.Combines(contradicted)}};
    Tell(std::move(told), type, pieces.size(), off, contradicted);
    if (contradicted && !anyway_) return;
    written_ = true;
    number = {.value = Digits(type.values.front()),
              .provenance = Origin::kMeasured,
              .source = Source(pieces),
              .uncertainty = Round(type.uncertainty, "%.3g")};
  }

  static Json NumberOrNull(const std::optional<double>& number) {
    return number ? Number(*number) : Json(nullptr);
  }

  void Tell(Json told, const TypeNumber& type, std::size_t pieces,
            const std::optional<std::string>& off, bool contradicted) {
    told["pieces"] = pieces;
    told["spread"] = NumberOrNull(type.spread);
    told["standard_error"] = NumberOrNull(type.standard_error);
    told["contradiction"] = contradicted ? Json(*off) : Json(nullptr);
    told["warning"] = off && !contradicted ? Json(*off) : Json(nullptr);
    told["written"] = !contradicted || anyway_;
    if (contradicted && !anyway_) Refuse(told["field"].get<std::string>() + ": " + *off);
    told_["numbers"].push_back(std::move(told));
  }

  // The curve is one number: it is written whole, or not.
  void TakeCurve(const std::vector<const Json*>& rows) {
    if (!part_.curve || part_.curve->points.size() != rows.size())
      return Block("the curve of " + part_.id + " has other points than the rig's");
    catalog::Curve& curve = *part_.curve;
    Stored stored{{}, curve.free_air_provenance, curve.free_air_uncertainty, curve.free_air_source};
    PieceTest fitted{specimen_, {}, LargestShare(rows)};
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const bool stays = Stays(curve.points[i], *rows[i]);
      if (!rows[i]->at("refused").is_null() && !stays)
        return Block("free_air at " + Decimal(rows[i]->at("pressure_kpa_gauge").get<double>()) +
                     " kPa " + rows[i]->at("refused").get<std::string>());
      stored.values.push_back(curve.points[i].free_air_l_per_min);
      fitted.values.push_back(stays ? stored.values.back() : rows[i]->at("fitted").get<double>());
    }
    const NewTest test(stored, fitted);
    std::vector<std::optional<std::string>> off(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (!Stays(curve.points[i], *rows[i]))
        off[i] = test.OffAt(i, {fitted.values[i], DeviationOf(*rows[i])},
                            kCurveShare * stored.values.front());
    const bool any_off = std::any_of(off.begin(), off.end(), [](const auto& one) { return one; });
    const bool contradicted = any_off && !test.OfAnEstimate();
    if (repeated_ && !contradicted) return;
    const std::vector<PieceTest> pieces = test.Pieces(contradicted);
    const TypeNumber type = OfType(pieces);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (fitted.values[i] > 0.0 && !Stays(curve.points[i], *rows[i]))
        TellPoint(curve, i, fitted.values[i], type, pieces.size(), test.Combines(contradicted),
                  off[i], contradicted);
    if (contradicted && !anyway_) return;
    written_ = true;
    for (std::size_t i = 0; i < rows.size(); ++i)
      curve.points[i].free_air_l_per_min = Digits(type.values[i]);
    curve.free_air_uncertainty = Round(type.uncertainty, "%.3g");
    curve.free_air_provenance = Origin::kMeasured;
    curve.free_air_source = Source(pieces);
  }

  void TellPoint(const catalog::Curve& curve, std::size_t i, double fitted, const TypeNumber& type,
                 std::size_t pieces, bool combined, const std::optional<std::string>& off,
                 bool contradicted) {
    const catalog::CurvePoint& point = curve.points[i];
    Json told = {{"field", "free_air at " + Decimal(point.pressure_kpa_gauge) + " kPa"},
                 {"before", Number(point.free_air_l_per_min)},
                 {"before_provenance", catalog::Name(curve.free_air_provenance)},
                 {"before_uncertainty", NumberOrNull(curve.free_air_uncertainty)},
                 {"measured", Number(Digits(fitted))},
                 {"uncertainty", Number(type.uncertainty)},
                 {"value", Number(Digits(type.values[i]))},
                 {"combined", combined}};
    Tell(std::move(told), type, pieces, off, contradicted && off);
    told_["numbers"].back()["written"] = !contradicted || anyway_;
  }

  static double DeviationOf(const Json& row) {
    if (row.at("uncertainty").is_null()) return 0.0;
    return row.at("fitted").get<double>() * row.at("uncertainty").get<double>();
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
    const std::string piece = specimen_.empty() ? "" : ", piece " + specimen_;
    for (const auto& file : files_)
      if (!IsDocument(file)) part_.documents.push_back({file.name + piece, file.sha256});
    part_.origin = "user";  // new seed rows do not take it back
  }

  catalog::Part part_;
  const Json& answer_;
  const Files& files_;
  bool anyway_;
  std::string specimen_;
  bool repeated_ = false, blocked_ = false, written_ = false;
  Json told_;
};

}  // namespace

PartRevision RevisePart(const catalog::Part& part, const Json& answer,
                        const std::vector<Provenance::File>& files, bool anyway,
                        const std::string& specimen) {
  return Revising(part, answer, files, anyway, specimen).Take();
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

std::string WhyInvalidSpecimen(const std::string& specimen, const std::string& id) {
  if (specimen.empty()) return "";
  if (id.empty()) return "names a piece of no part: say which part is saved, too";
  const bool plain = std::none_of(specimen.begin(), specimen.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
  });
  if (plain && specimen.size() <= kSpecimenNameMax) return "";
  return "must be a name of at most " + std::to_string(kSpecimenNameMax) +
         " bytes on one line, not " + Quoted(specimen);
}

Json SavePart(catalog::Store& store, const std::string& id, const Json& answer,
              const std::vector<Provenance::File>& files, bool anyway, const catalog::Signature& by,
              const std::string& specimen) {
  const std::optional<catalog::Part> stored = store.Get(id);
  if (!stored)
    return {{"part", id},
            {"specimen", specimen.empty() ? Json(nullptr) : Json(specimen)},
            {"numbers", Json::array()},
            {"refused", Json::array({"the catalogue has no part " + Quoted(id)})},
            {"revision", nullptr}};
  PartRevision revised = RevisePart(*stored, answer, files, anyway, specimen);
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
