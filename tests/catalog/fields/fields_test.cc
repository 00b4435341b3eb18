#include "catalog/fields/fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "tests/catalog/samples.h"

namespace plenum::catalog {
namespace fields_test {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;

auto Error(const std::string& field, const std::string& part_of_detail) {
  return AllOf(Field(&FieldError::field, field),
               Field(&FieldError::detail, HasSubstr(part_of_detail)));
}

Part Pump() {
  std::mt19937 random(1);
  Part part = AnyPart(*FindFamily("compressor"), "pump", random);
  part.curve->points = {{0, 10, 2}, {100, 5, 3}};
  return part;
}

TEST(Fields, EveryRangeIsFiniteAndEveryNameUnique) {
  for (const Family& family : Families()) {
    std::set<std::string_view> names;
    for (const NumberField& field : family.numbers) {
      EXPECT_LT(field.min, field.max) << field.name;
      EXPECT_GE(field.min, -1e6) << field.name << ": wider than the database's check";
      EXPECT_LE(field.max, 1e6) << field.name << ": wider than the database's check";
      EXPECT_TRUE(names.insert(field.name).second) << field.name;
    }
    for (const TextField& field : family.texts)
      EXPECT_TRUE(names.insert(field.name).second) << field.name;
  }
  EXPECT_EQ(FindFamily("valves"), nullptr);
}

TEST(Validate, AcceptsRandomValidParts) {
  std::mt19937 random(7);
  for (const Family& family : Families())
    for (int i = 0; i < 50; ++i)
      EXPECT_THAT(Validate(AnyPart(family, "id", random)), ElementsAre()) << family.name;
}

TEST(Validate, KnowsGoodAndBadIds) {
  for (const char* id : {"a", "0", "smc.tu-0425_b", "x1"})
    EXPECT_THAT(Validate(Reservoir(id)), ElementsAre()) << id;
  EXPECT_THAT(Validate(Reservoir(std::string(100, 'a'))), ElementsAre());
  for (const std::string& id : {std::string(), std::string("A"), std::string("-a"),
                                std::string("a b"), std::string(101, 'a'), std::string("ä")})
    EXPECT_THAT(Validate(Reservoir(id)), ElementsAre(Error("id", "1 to 100"))) << id;
  EXPECT_THAT(Validate(Reservoir("custom")), ElementsAre(Error("id", "made-to-measure")));
}

TEST(Validate, NamesValueAndRangeOfANumber) {
  Part part = Reservoir("r");
  part.numbers["mass_kg"].value = 900;
  EXPECT_THAT(Validate(part), ElementsAre(Error("mass_kg", "between 1e-06 and 500, is 900")));
  for (const double bad :
       {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::quiet_NaN(), 0.0, -1.0}) {
    part.numbers["mass_kg"].value = bad;
    EXPECT_THAT(Validate(part), ElementsAre(Error("mass_kg", "between"))) << bad;
  }
  part.numbers.erase("mass_kg");
  EXPECT_THAT(Validate(part), ElementsAre(Error("mass_kg", "required")));
}

TEST(Validate, ASuctionCurveRunsFromTheDeepestVacuumUpToAmbient) {
  std::mt19937 random(1);
  Part part = AnyPart(*FindFamily("vacuum_pump"), "pump", random);
  part.curve->points = {{-85, 0, 1}, {-40, 8, 1}, {0, 15, 1}};
  EXPECT_THAT(Validate(part), ElementsAre());
  part.curve->points = {{-85, 15, 1}, {0, 0, 1}};
  EXPECT_THAT(Validate(part), ElementsAre(Error("curve", "at least that of the point before, 15")));
  part.curve->points = {{-102, 0, 1}, {10, 5, 1}};
  EXPECT_THAT(Validate(part), ElementsAre(Error("curve", "between -101.325 and 0, is -102"),
                                          Error("curve", "between -101.325 and 0, is 10")));
}

TEST(Validate, SuggestsTheNearestFieldName) {
  Part part = Reservoir("r");
  part.numbers["mas_kg"] = {1.0, Provenance::kDatasheet, ""};
  EXPECT_THAT(Validate(part), ElementsAre(Error("mas_kg", "nearest: mass_kg")));
  part = Reservoir("r");
  part.texts["colour"] = {"red", Provenance::kDatasheet, ""};
  EXPECT_THAT(Validate(part), ElementsAre(Error("colour", "unknown field of family reservoir")));
}

TEST(Validate, ChecksTexts) {
  std::mt19937 random(3);
  Part valve = AnyPart(*FindFamily("valve"), "v", random);
  valve.texts["function"].value = "5/2";
  EXPECT_THAT(Validate(valve), ElementsAre(Error("function", "3/2, 2/2 pair, proportional")));
  valve.texts["function"].value = "3/2";
  valve.texts["port"].value = "";
  EXPECT_THAT(Validate(valve), ElementsAre(Error("port", "1 to 200")));
  Part part = Reservoir("r");
  part.manufacturer = "";
  part.part_number = std::string(201, 'p');
  part.notes = "\xFF";
  EXPECT_THAT(Validate(part),
              ElementsAre(Error("manufacturer", "has 0"), Error("part_number", "has 201"),
                          Error("notes", "UTF-8")));
}

TEST(Validate, ChecksSeriesListsAndUncertainty) {
  const Part good = Reservoir("r");
  const Offer offer{"Shop", 1.0, "EUR", 1.0, "2024-02-29", "https://example.org"};
  const auto with_offer = [&](auto change) {
    Part part = good;
    part.offers = {offer, offer};
    change(part.offers[1]);
    return Validate(part);
  };
  EXPECT_THAT(with_offer([](Offer&) {}), ElementsAre());
  for (const char* date : {"", "2024", "2024-12", "1999-12-31"})
    EXPECT_THAT(with_offer([&](Offer& o) { o.date = date; }), ElementsAre()) << date;
  for (const char* date : {"2023-02-29", "2024-13", "24", "2024-1-1", "2024/01/01", "2024-", "now"})
    EXPECT_THAT(with_offer([&](Offer& o) { o.date = date; }),
                ElementsAre(Error("offers", std::string("offer 2: date must be like 2024"))))
        << date;
  EXPECT_THAT(with_offer([](Offer& o) { o.currency = "XYZ"; }),
              ElementsAre(Error("offers", "offer 2: currency must be one of: EUR, AUD")));
  for (const double bad : {-1.0, 1e10, std::nan("")})
    EXPECT_THAT(with_offer([&](Offer& o) { o.price = bad; }),
                ElementsAre(Error("offers", "price must be between 0 and 1e+09")));
  for (const double bad : {0.0, -1.0, 1e7, std::nan("")})
    EXPECT_THAT(with_offer([&](Offer& o) { o.pack = bad; }),
                ElementsAre(Error("offers", "pack must be > 0")));
  EXPECT_THAT(with_offer([](Offer& o) { o.supplier = ""; }),
              ElementsAre(Error("offers", "offer 2: supplier must have 1 to 200")));
  EXPECT_THAT(with_offer([](Offer& o) { o.link = std::string(1001, 'x'); }),
              ElementsAre(Error("offers", "has 1001")));

  Part part = good;
  part.documents = {{"", ""}};
  EXPECT_THAT(Validate(part), ElementsAre(Error("documents", "document 1: needs a link")));
  part.documents = {{"", "ABC"}};
  EXPECT_THAT(Validate(part), ElementsAre(Error("documents", "64 digits")));
  part = good;
  part.aliases = {"a", "b", "a"};
  EXPECT_THAT(Validate(part), ElementsAre(Error("aliases", "different from each other")));
  for (int i = 0; i < 14; ++i) part.aliases.push_back(std::to_string(i));
  part.aliases[2] = "c";
  EXPECT_THAT(Validate(part), ElementsAre(Error("aliases", "at most 16 items, has 17")));
  part = good;
  part.series = std::string(201, 's');
  EXPECT_THAT(Validate(part), ElementsAre(Error("series", "has 201")));
  part = good;
  part.manufacturer = "generic";
  EXPECT_THAT(Validate(part), ElementsAre());
  part.orderable = true;
  EXPECT_THAT(Validate(part), ElementsAre(Error("orderable", "generic")));
  part = good;
  for (const double bad : {0.0, -0.1, 1.1, std::nan("")}) {
    part.numbers["mass_kg"].uncertainty = bad;
    EXPECT_THAT(Validate(part), ElementsAre(Error("mass_kg.uncertainty", "between 1e-06 and 1")));
  }
  Part pump = Pump();
  pump.curve->current_uncertainty = 2;
  EXPECT_THAT(Validate(pump), ElementsAre(Error("current.uncertainty", "is 2")));
}

TEST(Validate, ReportsUnknownFamilyAndOrigin) {
  Part part = Reservoir("r");
  part.family = "tank";
  part.origin = "me";
  EXPECT_THAT(Validate(part), ElementsAre(Error("origin", "\"me\""), Error("family", "reservoir")));
}

TEST(Validate, ChecksCurves) {
  EXPECT_THAT(Validate(Pump()), ElementsAre());
  Part pump = Pump();
  pump.curve.reset();
  EXPECT_THAT(Validate(pump), ElementsAre(Error("curve", "required")));
  pump = Pump();
  pump.curve->points.clear();
  EXPECT_THAT(Validate(pump), ElementsAre(Error("curve", "has 0")));
  pump.curve->points.resize(65, {0, 1, 1});
  EXPECT_THAT(Validate(pump), ElementsAre(Error("curve", "has 65")));
  for (const CurvePoint& bad : {CurvePoint{0, 5, 3}, CurvePoint{100, 11, 3}, CurvePoint{100, 5, 0},
                                CurvePoint{100, -1, 3}, CurvePoint{100, 5, 1001}}) {
    pump.curve->points = {{0, 10, 2}, bad};
    EXPECT_THAT(Validate(pump), ElementsAre(Error("curve", "point 2")));
  }
  for (const double bad : {std::numeric_limits<double>::infinity(), std::nan("")}) {
    pump.curve->points = {{0, 10, bad}};
    EXPECT_THAT(Validate(pump), ElementsAre(Error("curve", "current in A")));
  }
  Part tank = Reservoir("r");
  tank.curve = Pump().curve;
  EXPECT_THAT(Validate(tank), ElementsAre(Error("curve", "no curve")));
}

TEST(Validate, ChecksPairsAndWholeNumbers) {
  std::mt19937 random(5);
  Part tube = AnyPart(*FindFamily("tubing"), "t", random);
  tube.numbers["inner_diameter_mm"].value = 4.0;
  EXPECT_THAT(Validate(tube),
              ElementsAre(Error("inner_diameter_mm", "below outer_diameter_mm, 4")));
  Part regulator = AnyPart(*FindFamily("regulator"), "g", random);
  regulator.numbers["outlet_pressure_min_kpa_gauge"].value = 500;
  regulator.numbers["outlet_pressure_max_kpa_gauge"].value = 400;
  EXPECT_THAT(Validate(regulator), ElementsAre(Error("outlet_pressure_min_kpa_gauge", "at most")));
  Part valve = AnyPart(*FindFamily("valve"), "v", random);
  valve.numbers["channels"].value = 1.5;
  EXPECT_THAT(Validate(valve), ElementsAre(Error("channels", "whole number, is 1.5")));
}

}  // namespace fields_test
}  // namespace plenum::catalog
