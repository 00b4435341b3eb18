#include "catalog/tables/printed/printed_columns.h"

#include <algorithm>
#include <utility>

#include "catalog/fields/list_cell.h"

namespace plenum::catalog {
namespace {

constexpr std::string_view kBody = "body_volume_ml", kCurve = "curve", kOffers = "offers",
                           kCurrentMax = "current_max_a", kCapacity = "capacity_ah";
constexpr PrintedColumn kColumns[] = {
    {{"body_length_mm", 0, 0, false, "longest side, or length of a round body"}, kBody},
    {{"body_width_mm", 0, 0, false, "width of the body"}, kBody},
    {{"body_height_mm", 0, 0, false, "height of the body"}, kBody},
    {{"body_depth_mm", 0, 0, false, "depth or thickness of the body"}, kBody},
    {{"body_diameter_mm", 0, 0, false, "diameter of a round body"}, kBody},
    {{kBodySize, 0, 0, false, "three sides of the body, 70 x 30 x 50"}, kBody},
    {{kBodyCylinder, 0, 0, false, "diameter and length of the body, 18.5 x 65"}, kBody},
    {{"free_flow_l_per_min", 0, 0, false, "flow of a pump against no pressure"}, kCurve},
    {{"current_a", 0, 0, false, "highest current of a pump"}, kCurve},
    {{"c_rate", 0, 0, false, "continuous current over capacity, in 1/h"}, kCurrentMax, false},
    {{"energy_wh", 0, 0, false, "energy of a battery"}, kCapacity},
    {{kOfferPrice, 0, 0, false, "price of a pack, in its currency"}, kOffers, false},
    {{kOfferCurrency, 0, 0, false, "currency of the price"}, kOffers, false},
    {{"offer_pack", 0, 0, false, "pieces in a pack"}, kOffers, false},
    {{"offer_supplier", 0, 0, false, "who sells it"}, kOffers, false},
    {{"offer_date", 0, 0, false, "date of the price"}, kOffers, false},
    {{"offer_link", 0, 0, false, "where it is sold"}, kOffers, false},
};

bool Has(const Family& family, std::string_view number) {
  return std::any_of(family.numbers.begin(), family.numbers.end(),
                     [&](const NumberField& field) { return field.name == number; });
}

bool BelongsTo(const PrintedColumn& column, const Family& family) {
  if (column.gives == kCurve) return family.has_curve();
  return column.gives == kOffers || Has(family, column.gives);
}

using Cells = std::map<std::string, std::string, std::less<>>;

std::string Of(const Cells& cells, std::string_view name) {
  const auto found = cells.find(name);
  return found == cells.end() ? "" : found->second;
}

std::string BodyCell(const Cells& cells) {
  if (const std::string size = Of(cells, kBodySize); !size.empty()) return size;
  if (const std::string size = Of(cells, kBodyCylinder); !size.empty()) return size;
  std::vector<std::string> sides;
  for (const char* side : {"body_length_mm", "body_width_mm", "body_height_mm", "body_depth_mm"})
    if (std::string given = Of(cells, side); !given.empty()) sides.push_back(std::move(given));
  const std::string across = Of(cells, "body_diameter_mm");
  if (sides.size() == 3 && across.empty())
    return sides[0] + " x " + sides[1] + " x " + sides[2] + " mm";
  if (sides.size() == 1 && !across.empty()) return "⌀" + across + " x " + sides[0] + " mm";
  return "";
}

std::string CurveCell(const Cells& cells) {
  const std::string flow = Of(cells, "free_flow_l_per_min"), current = Of(cells, "current_a");
  if (flow.empty()) return "";
  return "free flow " + flow + " L/min" + (current.empty() ? "" : ", " + current + " A");
}

std::string EnergyCell(const Cells& cells) {
  const std::string energy = Of(cells, "energy_wh");
  return energy.empty() ? "" : energy + " Wh";
}

std::string OffersCell(const Cells& cells) {
  const std::string price = Of(cells, kOfferPrice);
  if (price.empty()) return "";
  const auto member = [&](const char* name, const std::string& value) {
    return value.empty() ? std::string() : std::string(",\"") + name + "\":" + QuoteJson(value);
  };
  const std::string supplier = Of(cells, "offer_supplier"), pack = Of(cells, "offer_pack");
  return "[{\"supplier\":" + QuoteJson(supplier.empty() ? "not named" : supplier) +
         ",\"price\":" + price + member("currency", Of(cells, kOfferCurrency)) +
         (pack.empty() ? "" : ",\"pack\":" + pack) + member("date", Of(cells, "offer_date")) +
         member("link", Of(cells, "offer_link")) + "}]";
}

}  // namespace

std::vector<const PrintedColumn*> PrintedColumns(const Family& family) {
  std::vector<const PrintedColumn*> columns;
  for (const PrintedColumn& column : kColumns)
    if (BelongsTo(column, family)) columns.push_back(&column);
  return columns;
}

const PrintedColumn* FindPrinted(const Family& family, std::string_view name) {
  for (const PrintedColumn& column : kColumns)
    if (column.field.name == name && BelongsTo(column, family)) return &column;
  return nullptr;
}

std::string CellFromPrinted(std::string_view column, const Cells& printed) {
  if (column == kBody) return BodyCell(printed);
  if (column == kCurve) return CurveCell(printed);
  if (column == kCurrentMax) return Of(printed, "c_rate");
  if (column == kCapacity) return EnergyCell(printed);
  return column == kOffers ? OffersCell(printed) : "";
}

}  // namespace plenum::catalog
