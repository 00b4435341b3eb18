// Tests of pieces of one type, as the source of a measured number remembers them.
//
//   fitted to pump_b.csv; pieces: "A" 5.71 ± 0.0072; "B" 5.52 ± 0.0071
//
// Of each piece stands what all its tests say together: the number, or a curve's values by point,
// and the relative standard deviation. A test that names no piece is of the piece "".
#ifndef PLENUM_API_PROTOCOL_PIECE_TESTS_H_
#define PLENUM_API_PROTOCOL_PIECE_TESTS_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plenum::api {

struct PieceTest {
  std::string piece;
  std::vector<double> values;
  double uncertainty = 0.0;  // relative, one standard deviation
  bool operator==(const PieceTest&) const = default;
};

// None where the text remembers none, or is not as above.
std::vector<PieceTest> PiecesOf(std::string_view source);
std::string WithPieces(const std::string& source, const std::vector<PieceTest>& pieces);

// Two tests of one piece, by weights 1/(u·value)².
PieceTest Combined(const PieceTest& a, const PieceTest& b);

// A type, by its pieces: their mean. From two pieces on `spread` is the relative standard deviation
// between them and `standard_error` that of the mean; `uncertainty` is that of a piece drawn at
// random: both together, and no less than that of the worst test. Of a curve they are the largest
// over the points with at least kCurveShare of its largest value.
struct TypeNumber {
  std::vector<double> values;
  double uncertainty = 0.0;
  std::optional<double> spread, standard_error;
};
inline constexpr double kCurveShare = 0.1;
TypeNumber OfType(const std::vector<PieceTest>& pieces);

}  // namespace plenum::api

#endif  // PLENUM_API_PROTOCOL_PIECE_TESTS_H_
