-- Parts with a row per number and per text, each with where it comes from. NaN arrives as NULL and
-- is refused by NOT NULL; infinity passes an open CHECK, so every number is bounded on both sides.
-- The ranges of single fields live in catalog/fields/fields.cc; here is their envelope.
PRAGMA application_id = 1886154349;

CREATE TABLE migration (
  number INTEGER NOT NULL PRIMARY KEY CHECK (number BETWEEN 1 AND 9999),
  name TEXT NOT NULL UNIQUE,
  applied TEXT NOT NULL
) STRICT;

-- Counts committed writes.
CREATE TABLE revision (
  one INTEGER NOT NULL PRIMARY KEY CHECK (one = 1),
  number INTEGER NOT NULL CHECK (number >= 0)
) STRICT;
INSERT INTO revision VALUES (1, 0);

CREATE TABLE part (
  id TEXT NOT NULL PRIMARY KEY CHECK (length(id) BETWEEN 1 AND 100 AND id NOT GLOB '*[^a-z0-9._-]*'
    AND id GLOB '[a-z0-9]*' AND id <> 'custom'),
  family TEXT NOT NULL CHECK (family IN ('tubing', 'fitting', 'valve', 'compressor', 'cylinder',
    'co2', 'battery', 'regulator', 'reservoir')),
  manufacturer TEXT NOT NULL CHECK (length(manufacturer) BETWEEN 1 AND 200),
  part_number TEXT NOT NULL CHECK (length(part_number) BETWEEN 1 AND 200),
  origin TEXT NOT NULL CHECK (origin IN ('seed', 'user')),
  notes TEXT NOT NULL
) STRICT, WITHOUT ROWID;
CREATE INDEX part_by_family ON part (family, id);

CREATE TABLE number (
  part_id TEXT NOT NULL REFERENCES part (id) ON DELETE CASCADE,
  field TEXT NOT NULL CHECK (length(field) BETWEEN 1 AND 100),
  value REAL NOT NULL CHECK (value BETWEEN 0 AND 1e6),
  provenance TEXT NOT NULL
    CHECK (provenance IN ('datasheet', 'third_party', 'derived', 'estimated')),
  source TEXT NOT NULL,
  PRIMARY KEY (part_id, field)
) STRICT, WITHOUT ROWID;

CREATE TABLE text (
  part_id TEXT NOT NULL REFERENCES part (id) ON DELETE CASCADE,
  field TEXT NOT NULL CHECK (length(field) BETWEEN 1 AND 100),
  value TEXT NOT NULL CHECK (length(value) BETWEEN 1 AND 200),
  provenance TEXT NOT NULL
    CHECK (provenance IN ('datasheet', 'third_party', 'derived', 'estimated')),
  source TEXT NOT NULL,
  PRIMARY KEY (part_id, field)
) STRICT, WITHOUT ROWID;

CREATE TABLE curve (
  part_id TEXT NOT NULL PRIMARY KEY REFERENCES part (id) ON DELETE CASCADE,
  free_air_provenance TEXT NOT NULL
    CHECK (free_air_provenance IN ('datasheet', 'third_party', 'derived', 'estimated')),
  free_air_source TEXT NOT NULL,
  current_provenance TEXT NOT NULL
    CHECK (current_provenance IN ('datasheet', 'third_party', 'derived', 'estimated')),
  current_source TEXT NOT NULL
) STRICT, WITHOUT ROWID;

CREATE TABLE curve_point (
  part_id TEXT NOT NULL REFERENCES curve (part_id) ON DELETE CASCADE,
  pressure_kpa_gauge REAL NOT NULL CHECK (pressure_kpa_gauge BETWEEN 0 AND 5e4),
  free_air_l_per_min REAL NOT NULL CHECK (free_air_l_per_min BETWEEN 0 AND 1e6),
  current_a REAL NOT NULL CHECK (current_a > 0 AND current_a <= 1e3),
  PRIMARY KEY (part_id, pressure_kpa_gauge)
) STRICT, WITHOUT ROWID;
