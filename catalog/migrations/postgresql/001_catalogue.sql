-- The catalogue on PostgreSQL 15: the tables that the migrations for SQLite end with, with the same
-- names, columns and limits. Text is compared as bytes (COLLATE "C"), so that every order is that of
-- SQLite. A number of revisions, versions and endings fits into a double (2^53 - 1), for JSON.
CREATE TABLE migration (
  number bigint NOT NULL PRIMARY KEY CHECK (number BETWEEN 1 AND 9999),
  name text COLLATE "C" NOT NULL UNIQUE,
  applied text NOT NULL
);

CREATE TABLE revision (
  number bigint NOT NULL PRIMARY KEY CHECK (number BETWEEN 0 AND 9007199254740991),
  hash text CHECK (hash ~ '^[0-9a-f]{64}$'),  -- NULL only while the tables are made
  at text NOT NULL CHECK (length(at) = 20),
  who text NOT NULL CHECK (length(who) <= 200),
  what text NOT NULL CHECK (length(what) BETWEEN 1 AND 300)
);

CREATE TABLE change (
  revision bigint NOT NULL REFERENCES revision (number),
  part_id text COLLATE "C" NOT NULL CHECK (length(part_id) BETWEEN 1 AND 100),
  before text CHECK (length(before) BETWEEN 1 AND 1000000),  -- NULL: the part did not exist
  PRIMARY KEY (revision, part_id)
);
CREATE INDEX change_by_part ON change (part_id, revision);

CREATE TABLE request_key (
  key text COLLATE "C" NOT NULL PRIMARY KEY CHECK (length(key) BETWEEN 1 AND 255),
  request text NOT NULL CHECK (length(request) BETWEEN 1 AND 100),
  base bigint NOT NULL REFERENCES revision (number),
  revision bigint NOT NULL REFERENCES revision (number),
  at text COLLATE "C" NOT NULL CHECK (length(at) = 20)
);
CREATE INDEX request_key_by_age ON request_key (at);

CREATE TABLE model (
  name text COLLATE "C" NOT NULL CHECK (name ~ '^[a-z0-9][a-z0-9._-]{0,99}$' AND name <> 'nominal'),
  version bigint NOT NULL CHECK (version BETWEEN 1 AND 9007199254740991),
  at text NOT NULL CHECK (length(at) = 20),
  who text NOT NULL CHECK (length(who) <= 200),
  document text NOT NULL CHECK (length(document) BETWEEN 2 AND 10000000),
  hash text NOT NULL CHECK (hash ~ '^[0-9a-f]{64}$'),
  PRIMARY KEY (name, version)
);

CREATE TABLE part (
  id text COLLATE "C" NOT NULL PRIMARY KEY
    CHECK (id ~ '^[a-z0-9][a-z0-9._-]{0,99}$' AND id <> 'custom'),
  family text COLLATE "C" NOT NULL CHECK (family ~ '^[a-z0-9_]{1,100}$'),
  manufacturer text NOT NULL CHECK (length(manufacturer) BETWEEN 1 AND 200),
  part_number text NOT NULL CHECK (length(part_number) BETWEEN 1 AND 200),
  origin text NOT NULL CHECK (origin IN ('seed', 'user')),
  notes text NOT NULL,
  series text NOT NULL CHECK (length(series) <= 200),
  orderable bigint CHECK (orderable IN (0, 1))  -- NULL: not known
);
CREATE INDEX part_by_family ON part (family, id);

CREATE TABLE number (
  part_id text COLLATE "C" NOT NULL REFERENCES part (id) ON DELETE CASCADE,
  field text COLLATE "C" NOT NULL CHECK (length(field) BETWEEN 1 AND 100),
  value double precision NOT NULL CHECK (value BETWEEN -1e6 AND 1e6),
  provenance text NOT NULL
    CHECK (provenance IN ('datasheet', 'third_party', 'derived', 'estimated', 'measured')),
  source text NOT NULL,
  uncertainty double precision CHECK (uncertainty > 0 AND uncertainty <= 1),  -- NULL: not known
  PRIMARY KEY (part_id, field)
);

CREATE TABLE text (
  part_id text COLLATE "C" NOT NULL REFERENCES part (id) ON DELETE CASCADE,
  field text COLLATE "C" NOT NULL CHECK (length(field) BETWEEN 1 AND 100),
  value text NOT NULL CHECK (length(value) BETWEEN 1 AND 200),
  provenance text NOT NULL
    CHECK (provenance IN ('datasheet', 'third_party', 'derived', 'estimated', 'measured')),
  source text NOT NULL,
  PRIMARY KEY (part_id, field)
);

CREATE TABLE curve (
  part_id text COLLATE "C" NOT NULL PRIMARY KEY REFERENCES part (id) ON DELETE CASCADE,
  free_air_provenance text NOT NULL
    CHECK (free_air_provenance IN ('datasheet', 'third_party', 'derived', 'estimated', 'measured')),
  free_air_source text NOT NULL,
  current_provenance text NOT NULL
    CHECK (current_provenance IN ('datasheet', 'third_party', 'derived', 'estimated', 'measured')),
  current_source text NOT NULL,
  free_air_uncertainty double precision
    CHECK (free_air_uncertainty > 0 AND free_air_uncertainty <= 1),
  current_uncertainty double precision CHECK (current_uncertainty > 0 AND current_uncertainty <= 1)
);

CREATE TABLE curve_point (
  part_id text COLLATE "C" NOT NULL REFERENCES curve (part_id) ON DELETE CASCADE,
  pressure_kpa_gauge double precision NOT NULL CHECK (pressure_kpa_gauge BETWEEN -200 AND 5e4),
  free_air_l_per_min double precision NOT NULL CHECK (free_air_l_per_min BETWEEN 0 AND 1e6),
  current_a double precision NOT NULL CHECK (current_a > 0 AND current_a <= 1e3),
  PRIMARY KEY (part_id, pressure_kpa_gauge)
);

CREATE TABLE alias (
  part_id text COLLATE "C" NOT NULL REFERENCES part (id) ON DELETE CASCADE,
  place bigint NOT NULL CHECK (place BETWEEN 0 AND 99),
  alias text NOT NULL CHECK (length(alias) BETWEEN 1 AND 200),
  PRIMARY KEY (part_id, place)
);

CREATE TABLE offer (
  part_id text COLLATE "C" NOT NULL REFERENCES part (id) ON DELETE CASCADE,
  place bigint NOT NULL CHECK (place BETWEEN 0 AND 99),
  supplier text NOT NULL CHECK (length(supplier) BETWEEN 1 AND 200),
  price double precision NOT NULL CHECK (price BETWEEN 0 AND 1e9),
  currency text NOT NULL CHECK (currency ~ '^[A-Z]{3}$'),
  pack double precision NOT NULL CHECK (pack > 0 AND pack <= 1e6),
  date text NOT NULL CHECK (length(date) IN (0, 4, 7, 10)),
  link text NOT NULL,
  PRIMARY KEY (part_id, place)
);

CREATE TABLE document (
  part_id text COLLATE "C" NOT NULL REFERENCES part (id) ON DELETE CASCADE,
  place bigint NOT NULL CHECK (place BETWEEN 0 AND 99),
  link text NOT NULL,
  sha256 text NOT NULL CHECK (sha256 ~ '^([0-9a-f]{64})?$'),
  PRIMARY KEY (part_id, place)
);

CREATE FUNCTION refuse_change() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  RAISE EXCEPTION '%', TG_ARGV[0];
END $$;
CREATE TRIGGER revision_is_not_deleted BEFORE DELETE ON revision
  FOR EACH ROW EXECUTE FUNCTION refuse_change('a revision is never deleted');
CREATE TRIGGER revision_is_not_changed BEFORE UPDATE ON revision
  FOR EACH ROW WHEN (OLD.hash IS NOT NULL)
  EXECUTE FUNCTION refuse_change('a revision is never changed');
CREATE TRIGGER change_is_not_deleted BEFORE DELETE ON change
  FOR EACH ROW EXECUTE FUNCTION refuse_change('history is never deleted');
CREATE TRIGGER change_is_not_changed BEFORE UPDATE ON change
  FOR EACH ROW EXECUTE FUNCTION refuse_change('history is never changed');
CREATE TRIGGER model_is_not_deleted BEFORE DELETE ON model
  FOR EACH ROW EXECUTE FUNCTION refuse_change('a model revision is never deleted');
CREATE TRIGGER model_is_not_changed BEFORE UPDATE ON model
  FOR EACH ROW EXECUTE FUNCTION refuse_change('a model revision is never changed');

INSERT INTO revision VALUES
  (0, NULL, to_char(now() AT TIME ZONE 'UTC', 'YYYY-MM-DD"T"HH24:MI:SS"Z"'), '', 'history begins');
