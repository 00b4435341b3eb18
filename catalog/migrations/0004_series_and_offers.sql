-- Series, aliases, offers, documents, whether a part can be ordered, an uncertainty per number, and
-- numbers that were measured. SQLite cannot widen a CHECK, so the tables are made anew; children
-- are dropped before their parents, which would take them along. Which families there are and which
-- fields they have is known to catalog/fields/fields.cc alone, so that a new family needs no
-- migration.
CREATE TABLE part_new (
  id TEXT NOT NULL PRIMARY KEY CHECK (length(id) BETWEEN 1 AND 100 AND id NOT GLOB '*[^a-z0-9._-]*'
    AND id GLOB '[a-z0-9]*' AND id <> 'custom'),
  family TEXT NOT NULL CHECK (length(family) BETWEEN 1 AND 100 AND family NOT GLOB '*[^a-z0-9_]*'),
  manufacturer TEXT NOT NULL CHECK (length(manufacturer) BETWEEN 1 AND 200),
  part_number TEXT NOT NULL CHECK (length(part_number) BETWEEN 1 AND 200),
  origin TEXT NOT NULL CHECK (origin IN ('seed', 'user')),
  notes TEXT NOT NULL,
  series TEXT NOT NULL CHECK (length(series) <= 200),
  orderable INTEGER CHECK (orderable IN (0, 1))  -- NULL: not known
) STRICT, WITHOUT ROWID;
INSERT INTO part_new SELECT id, family, manufacturer, part_number, origin, notes, '', NULL FROM part;

CREATE TABLE number_new (
  part_id TEXT NOT NULL REFERENCES part_new (id) ON DELETE CASCADE,
  field TEXT NOT NULL CHECK (length(field) BETWEEN 1 AND 100),
  value REAL NOT NULL CHECK (value BETWEEN -1e6 AND 1e6),
  provenance TEXT NOT NULL
    CHECK (provenance IN ('datasheet', 'third_party', 'derived', 'estimated', 'measured')),
  source TEXT NOT NULL,
  uncertainty REAL CHECK (uncertainty > 0 AND uncertainty <= 1),  -- NULL: not known
  PRIMARY KEY (part_id, field)
) STRICT, WITHOUT ROWID;
INSERT INTO number_new SELECT part_id, field, value, provenance, source, NULL FROM number;

CREATE TABLE text_new (
  part_id TEXT NOT NULL REFERENCES part_new (id) ON DELETE CASCADE,
  field TEXT NOT NULL CHECK (length(field) BETWEEN 1 AND 100),
  value TEXT NOT NULL CHECK (length(value) BETWEEN 1 AND 200),
  provenance TEXT NOT NULL
    CHECK (provenance IN ('datasheet', 'third_party', 'derived', 'estimated', 'measured')),
  source TEXT NOT NULL,
  PRIMARY KEY (part_id, field)
) STRICT, WITHOUT ROWID;
INSERT INTO text_new SELECT part_id, field, value, provenance, source FROM text;

CREATE TABLE curve_new (
  part_id TEXT NOT NULL PRIMARY KEY REFERENCES part_new (id) ON DELETE CASCADE,
  free_air_provenance TEXT NOT NULL
    CHECK (free_air_provenance IN ('datasheet', 'third_party', 'derived', 'estimated', 'measured')),
  free_air_source TEXT NOT NULL,
  current_provenance TEXT NOT NULL
    CHECK (current_provenance IN ('datasheet', 'third_party', 'derived', 'estimated', 'measured')),
  current_source TEXT NOT NULL,
  free_air_uncertainty REAL CHECK (free_air_uncertainty > 0 AND free_air_uncertainty <= 1),
  current_uncertainty REAL CHECK (current_uncertainty > 0 AND current_uncertainty <= 1)
) STRICT, WITHOUT ROWID;
INSERT INTO curve_new SELECT part_id, free_air_provenance, free_air_source, current_provenance,
  current_source, NULL, NULL FROM curve;

-- A suction pressure is below ambient.
CREATE TABLE curve_point_new (
  part_id TEXT NOT NULL REFERENCES curve_new (part_id) ON DELETE CASCADE,
  pressure_kpa_gauge REAL NOT NULL CHECK (pressure_kpa_gauge BETWEEN -200 AND 5e4),
  free_air_l_per_min REAL NOT NULL CHECK (free_air_l_per_min BETWEEN 0 AND 1e6),
  current_a REAL NOT NULL CHECK (current_a > 0 AND current_a <= 1e3),
  PRIMARY KEY (part_id, pressure_kpa_gauge)
) STRICT, WITHOUT ROWID;
INSERT INTO curve_point_new
  SELECT part_id, pressure_kpa_gauge, free_air_l_per_min, current_a FROM curve_point;

DROP TABLE curve_point;
DROP TABLE curve;
DROP TABLE text;
DROP TABLE number;
DROP TABLE part;
ALTER TABLE part_new RENAME TO part;
ALTER TABLE number_new RENAME TO number;
ALTER TABLE text_new RENAME TO text;
ALTER TABLE curve_new RENAME TO curve;
ALTER TABLE curve_point_new RENAME TO curve_point;
CREATE INDEX part_by_family ON part (family, id);

-- Lists keep the order in which they were given.
CREATE TABLE alias (
  part_id TEXT NOT NULL REFERENCES part (id) ON DELETE CASCADE,
  place INTEGER NOT NULL CHECK (place BETWEEN 0 AND 99),
  alias TEXT NOT NULL CHECK (length(alias) BETWEEN 1 AND 200),
  PRIMARY KEY (part_id, place)
) STRICT, WITHOUT ROWID;

CREATE TABLE offer (
  part_id TEXT NOT NULL REFERENCES part (id) ON DELETE CASCADE,
  place INTEGER NOT NULL CHECK (place BETWEEN 0 AND 99),
  supplier TEXT NOT NULL CHECK (length(supplier) BETWEEN 1 AND 200),
  price REAL NOT NULL CHECK (price BETWEEN 0 AND 1e9),
  currency TEXT NOT NULL CHECK (length(currency) = 3 AND currency NOT GLOB '*[^A-Z]*'),
  pack REAL NOT NULL CHECK (pack > 0 AND pack <= 1e6),
  date TEXT NOT NULL CHECK (length(date) IN (0, 4, 7, 10)),
  link TEXT NOT NULL,
  PRIMARY KEY (part_id, place)
) STRICT, WITHOUT ROWID;

CREATE TABLE document (
  part_id TEXT NOT NULL REFERENCES part (id) ON DELETE CASCADE,
  place INTEGER NOT NULL CHECK (place BETWEEN 0 AND 99),
  link TEXT NOT NULL,
  sha256 TEXT NOT NULL
    CHECK (sha256 = '' OR (length(sha256) = 64 AND sha256 NOT GLOB '*[^0-9a-f]*')),
  PRIMARY KEY (part_id, place)
) STRICT, WITHOUT ROWID;
