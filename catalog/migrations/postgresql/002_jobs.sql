-- Jobs, who does them, and tokens. The tables that change often are small: requests and results stand
-- beside them and are written once. What is looked for is indexed; what a heartbeat writes is not, so
-- that it leaves no entry in an index behind.
CREATE SEQUENCE job_change;  -- counts changes of jobs, so that who waits sees that there was one
CREATE SEQUENCE job_turn;    -- counts beginnings, for whose turn it is
CREATE SEQUENCE job_ending;

CREATE TABLE job (
  number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
  id text COLLATE "C" NOT NULL UNIQUE CHECK (length(id) BETWEEN 1 AND 100),
  kind text COLLATE "C" NOT NULL CHECK (length(kind) BETWEEN 1 AND 100),
  version text COLLATE "C" NOT NULL CHECK (length(version) BETWEEN 1 AND 100),  -- of plenum
  name text NOT NULL CHECK (length(name) <= 1000000),
  who text NOT NULL CHECK (length(who) <= 200),
  key text COLLATE "C" CHECK (length(key) BETWEEN 1 AND 255),
  digest text CHECK (length(digest) BETWEEN 1 AND 100),
  revision bigint NOT NULL CHECK (revision BETWEEN 0 AND 9007199254740991),
  hash text NOT NULL CHECK (hash ~ '^[0-9a-f]{64}$'),
  model text NOT NULL CHECK (length(model) <= 100),
  model_version bigint NOT NULL CHECK (model_version BETWEEN 0 AND 9007199254740991),
  model_hash text NOT NULL CHECK (length(model_hash) IN (0, 64)),
  client text COLLATE "C" NOT NULL CHECK (length(client) <= 100),
  priority bigint NOT NULL CHECK (priority BETWEEN -100 AND 100),
  status text COLLATE "C" NOT NULL DEFAULT 'queued'
    CHECK (status IN ('queued', 'running', 'done', 'cancelled', 'failed')),
  starts bigint NOT NULL DEFAULT 0 CHECK (starts BETWEEN 0 AND 1000000),
  crashes bigint NOT NULL DEFAULT 0 CHECK (crashes BETWEEN 0 AND 1000000),  -- workers that were lost
  crashes_max bigint NOT NULL DEFAULT 10 CHECK (crashes_max BETWEEN 1 AND 1000001),
  crash text NOT NULL DEFAULT '' CHECK (length(crash) <= 1000),
  alone bigint NOT NULL DEFAULT 0 CHECK (alone IN (0, 1)),
  cancel_asked bigint NOT NULL DEFAULT 0 CHECK (cancel_asked IN (0, 1)),
  attempt text NOT NULL DEFAULT '' CHECK (length(attempt) <= 100),  -- whose result counts
  worker text NOT NULL DEFAULT '' CHECK (length(worker) <= 200),    -- for people
  lease_until timestamptz,
  turn bigint,  -- of job_turn, when it was begun last
  change bigint NOT NULL DEFAULT nextval('job_change'),
  submitted_at text NOT NULL CHECK (length(submitted_at) = 20),
  ended_at text CHECK (length(ended_at) = 20),
  ended bigint,  -- of job_ending
  bytes bigint NOT NULL CHECK (bytes >= 0),  -- of request and result
  progress text NOT NULL DEFAULT '',
  failure text NOT NULL DEFAULT '',
  UNIQUE (kind, key),
  CHECK ((ended IS NULL) = (status IN ('queued', 'running')) AND (ended IS NULL) = (ended_at IS NULL)),
  CHECK ((status = 'running') = (lease_until IS NOT NULL))
) WITH (fillfactor = 70, autovacuum_vacuum_scale_factor = 0.02, autovacuum_analyze_scale_factor = 0.02);
CREATE INDEX job_queued ON job (version, priority, client, number) WHERE status = 'queued';
CREATE INDEX job_running ON job (client) WHERE status = 'running';
CREATE INDEX job_turns ON job (client, turn) WHERE turn IS NOT NULL;
CREATE INDEX job_ended ON job (kind, ended) WHERE ended IS NOT NULL;

CREATE TABLE job_request (
  number bigint PRIMARY KEY REFERENCES job (number) ON DELETE CASCADE,
  request text NOT NULL
);
CREATE TABLE job_result (
  number bigint PRIMARY KEY REFERENCES job (number) ON DELETE CASCADE,
  result text NOT NULL
);

CREATE TABLE worker (
  id text COLLATE "C" PRIMARY KEY CHECK (length(id) BETWEEN 1 AND 100),
  name text NOT NULL CHECK (length(name) <= 200),
  version text NOT NULL CHECK (length(version) BETWEEN 1 AND 100),
  threads bigint NOT NULL CHECK (threads >= 0),
  seen_at timestamptz NOT NULL
) WITH (fillfactor = 50);

CREATE TABLE token (
  id text COLLATE "C" PRIMARY KEY CHECK (id ~ '^[0-9a-f]{8}$'),
  name text NOT NULL CHECK (length(name) BETWEEN 1 AND 100),
  scope text NOT NULL CHECK (scope IN ('read', 'write')),
  sha256 text COLLATE "C" NOT NULL UNIQUE CHECK (sha256 ~ '^[0-9a-f]{64}$'),
  created text COLLATE "C" NOT NULL CHECK (created ~ '^\d{4}-\d{2}-\d{2}$')
);
