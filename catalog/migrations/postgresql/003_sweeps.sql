-- Sweeps: jobs that were asked for together. Programs that do not know of them go on as before.
CREATE TABLE sweep (
  number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
  id text COLLATE "C" NOT NULL UNIQUE CHECK (length(id) BETWEEN 1 AND 100),
  kind text COLLATE "C" NOT NULL CHECK (length(kind) BETWEEN 1 AND 100),
  name text NOT NULL CHECK (length(name) <= 1000000),
  who text NOT NULL CHECK (length(who) <= 200),
  key text COLLATE "C" CHECK (length(key) BETWEEN 1 AND 255),
  digest text CHECK (length(digest) BETWEEN 1 AND 100),
  client text COLLATE "C" NOT NULL CHECK (length(client) <= 100),
  submitted_at text NOT NULL CHECK (length(submitted_at) = 20),
  revision bigint NOT NULL CHECK (revision BETWEEN 0 AND 9007199254740991),
  hash text NOT NULL CHECK (hash ~ '^[0-9a-f]{64}$'),
  plan text NOT NULL,
  UNIQUE (kind, key)
);
ALTER TABLE job ADD COLUMN sweep text COLLATE "C" REFERENCES sweep (id);
ALTER TABLE job ADD COLUMN place bigint NOT NULL DEFAULT 0 CHECK (place BETWEEN 0 AND 1000000);
CREATE INDEX job_of_sweep ON job (sweep, place) WHERE sweep IS NOT NULL;
