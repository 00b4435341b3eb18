#include "api/protocol/piece_tests.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "api/json/json.h"
#include "catalog/fields/list_cell.h"
#include "catalog/units/text.h"

namespace plenum::api {
namespace {

constexpr std::string_view kPieces = "; pieces: ", kBetween = "; ", kWithin = " ± ";

std::string SixDigits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

// The name that begins a text, in quotes as in JSON; takes it off. None where there is none.
std::optional<std::string> TakeName(std::string_view& text) {
  if (!text.starts_with('"')) return std::nullopt;
  std::size_t end = 1;
  while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
  if (end >= text.size()) return std::nullopt;
  catalog::TextList list = catalog::ParseTextList("[" + std::string(text.substr(0, end + 1)) + "]");
  if (!list.error.empty()) return std::nullopt;
  text.remove_prefix(end + 1);
  return std::move(list.items.front());
}

// What stands before the first `mark`; takes both off. The whole text where there is none.
std::string_view TakeUpTo(std::string_view mark, std::string_view& text) {
  const std::size_t at = text.find(mark);
  const std::string_view found = text.substr(0, at);
  text.remove_prefix(at == std::string_view::npos ? text.size() : at + mark.size());
  return found;
}

std::optional<PieceTest> TakePiece(std::string_view& text) {
  std::optional<std::string> name = TakeName(text);
  if (!name || !text.starts_with(' ')) return std::nullopt;
  text.remove_prefix(1);
  std::string_view values = TakeUpTo(kWithin, text);
  const auto uncertainty = catalog::ParseNumber(TakeUpTo(kBetween, text));
  if (!uncertainty || !(*uncertainty > 0.0)) return std::nullopt;
  PieceTest piece{std::move(*name), {}, *uncertainty};
  while (!values.empty()) {
    const auto value = catalog::ParseNumber(TakeUpTo(" ", values));
    if (!value) return std::nullopt;
    piece.values.push_back(*value);
  }
  if (piece.values.empty()) return std::nullopt;
  return piece;
}

// Mean and standard deviation of one point over all pieces, and the deviation of their tests.
struct Point {
  double mean = 0.0, spread = 0.0, tests = 0.0;
};
Point PointOf(const std::vector<PieceTest>& pieces, std::size_t at) {
  const auto count = static_cast<double>(pieces.size());
  Point point;
  for (const PieceTest& piece : pieces) point.mean += piece.values[at] / count;
  for (const PieceTest& piece : pieces) {
    if (count > 1.0) point.spread += std::pow(piece.values[at] - point.mean, 2) / (count - 1.0);
    point.tests += std::pow(piece.values[at] * piece.uncertainty, 2);
  }
  point.spread = std::sqrt(point.spread);
  point.tests = std::sqrt(point.tests) / count;
  return point;
}

}  // namespace

std::vector<PieceTest> PiecesOf(std::string_view source) {
  const std::size_t at = source.find(kPieces);
  if (at == std::string_view::npos) return {};
  std::string_view rest = source.substr(at + kPieces.size());
  std::vector<PieceTest> pieces;
  while (!rest.empty()) {
    std::optional<PieceTest> piece = TakePiece(rest);
    if (!piece || (!pieces.empty() && pieces.front().values.size() != piece->values.size()))
      return {};
    pieces.push_back(std::move(*piece));
  }
  return pieces;
}

std::string WithPieces(const std::string& source, const std::vector<PieceTest>& pieces) {
  std::string text = source;
  std::string_view before = kPieces;
  for (const PieceTest& piece : pieces) {
    text += before;
    text += catalog::QuoteJson(piece.piece);
    for (const double value : piece.values) text += " " + SixDigits(value);
    text += kWithin;
    text += SixDigits(piece.uncertainty);
    before = kBetween;
  }
  return text;
}

PieceTest Combined(const PieceTest& a, const PieceTest& b) {
  PieceTest both{a.piece, {}, 1.0 / std::hypot(1.0 / a.uncertainty, 1.0 / b.uncertainty)};
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double one = a.values[i], other = b.values[i];
    if (!(one > 0.0 && other > 0.0)) {
      both.values.push_back(other);
      continue;
    }
    const double weight_a = 1.0 / std::pow(one * a.uncertainty, 2);
    const double weight_b = 1.0 / std::pow(other * b.uncertainty, 2);
    both.values.push_back((weight_a * one + weight_b * other) / (weight_a + weight_b));
    if (a.values.size() == 1u)
      both.uncertainty = 1.0 / std::sqrt(weight_a + weight_b) / both.values.back();
  }
  return both;
}

TypeNumber OfType(const std::vector<PieceTest>& pieces) {
  TypeNumber type;
  std::vector<Point> points;
  for (std::size_t i = 0; i < pieces.front().values.size(); ++i) {
    points.push_back(PointOf(pieces, i));
    type.values.push_back(points.back().mean);
  }
  for (const PieceTest& piece : pieces)
    type.uncertainty = std::max(type.uncertainty, piece.uncertainty);
  if (pieces.size() < 2u) return type;
  const double largest = *std::max_element(type.values.begin(), type.values.end());
  double spread = 0.0, error = 0.0;
  for (const Point& point : points) {
    if (!(point.mean >= kCurveShare * largest) || !(point.mean > 0.0)) continue;
    const double of_mean =
        std::max(point.tests, point.spread / std::sqrt(static_cast<double>(pieces.size())));
    spread = std::max(spread, point.spread / point.mean);
    error = std::max(error, of_mean / point.mean);
  }
  type.spread = spread;
  type.standard_error = error;
  type.uncertainty = std::max(type.uncertainty, std::hypot(spread, error));
  return type;
}

}  // namespace plenum::api
