// Lines from the corners of their parts: exact for single parts, and for boxes a line that no line
// of the box outdoes. That holds because the exact march passes no less at any pressure ratio when
// the C or b of an element grows, and because less dead volume makes every stroke faster.
#ifndef PLENUM_OPTIMIZER_CHOICES_MAKE_LINE_H_
#define PLENUM_OPTIMIZER_CHOICES_MAKE_LINE_H_

#include "optimizer/choices/corner.h"
#include "optimizer/problem/proof.h"

namespace plenum::optimizer {

struct LineCorners {
  const TubeCorner& tube;
  const FittingCorner& fitting;
  const ValveCorner& valve;
};

// kNone, or why no source makes the line meet its group's limits: rise and fall time, half of the
// period, pressure ratings. `wider`: of a box that passed and holds this one; strokes that are the
// same are not looked at again.
Constraint ScreenLine(const Problem& problem, int group, model::Gas gas, const LineCorners& corners,
                      bool exact, const LineCorners* wider = nullptr);

// Without what FinishLine() adds. Of a single line the highest source pressure is also that whose
// peak keeps the group's limit (closing.h); of a box there may be lines that pass less.
Line AssembleLine(const Problem& problem, int group, model::Gas gas, const LineCorners& corners,
                  bool exact);

// Adds to a line that passed the least source pressure, found where the line is single and
// `with_curve`, else bounded from below; the least inflation time and, for a single line, the fall
// time; `with_curve`, for reservoirs, its curve and the panels of its strokes.
void FinishLine(const Problem& problem, int group, model::Gas gas, const ValveCorner& valve,
                bool exact, bool with_curve, Line& line);

// What FinishLine() would add to a box of lines, from a larger box that has the same fill strokes;
// false where they are not the same.
bool FinishLike(const Line& wider, const ValveCorner& valve, Line& line);

// All of it.
Constraint MakeLine(const Problem& problem, int group, model::Gas gas, const LineCorners& corners,
                    bool exact, bool with_curve, Line& line);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CHOICES_MAKE_LINE_H_
