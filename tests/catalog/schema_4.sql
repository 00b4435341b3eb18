-- catalog.db as the release with schema 4 left it: schema_3.sql migrated, a part with documents added.
PRAGMA foreign_keys=OFF;
BEGIN TRANSACTION;
PRAGMA application_id = 1886154349;
PRAGMA user_version = 4;
CREATE TABLE migration (
  number INTEGER NOT NULL PRIMARY KEY CHECK (number BETWEEN 1 AND 9999),
  name TEXT NOT NULL UNIQUE,
  applied TEXT NOT NULL
) STRICT;
INSERT INTO migration VALUES(1,'0001_parts','2026-11-21T02:10:30Z');
INSERT INTO migration VALUES(2,'0002_history','2026-11-21T07:52:36Z');
INSERT INTO migration VALUES(3,'0003_models','2026-11-21T07:56:15Z');
INSERT INTO migration VALUES(4,'0004_series_and_offers','2026-11-29T09:56:52Z');
CREATE TABLE revision (
  number INTEGER NOT NULL PRIMARY KEY CHECK (number BETWEEN 0 AND 9007199254740991),
  -- NULL only while this migration runs: SQL cannot compute it.
  hash TEXT CHECK (length(hash) = 64 AND hash NOT GLOB '*[^0-9a-f]*'),
  at TEXT NOT NULL CHECK (length(at) = 20),
  who TEXT NOT NULL CHECK (length(who) <= 200),
  what TEXT NOT NULL CHECK (length(what) BETWEEN 1 AND 300)
) STRICT;
INSERT INTO revision VALUES(7,'b2e30fa9c8574d2b8cba7fdf8e70b6b81fea95f7a786468ed3c047836173becc','2026-11-21T07:52:36Z','','history begins');
INSERT INTO revision VALUES(8,'bc30b12bdd654d47f3dec5d8e98e397f0eded3756a7c2f5ed79e6827a46f4e1f','2026-11-21T07:52:36Z','root','remove mine');
INSERT INTO revision VALUES(9,'b2e30fa9c8574d2b8cba7fdf8e70b6b81fea95f7a786468ed3c047836173becc','2026-11-21T07:52:36Z','root','undo 8');
INSERT INTO revision VALUES(10,'0d7cb8933b99a1221a6e8c50f2dd21076d7da53f953f10a61d0fa0f6beaf7846','2026-11-29T09:57:04Z','root','add documented');
CREATE TABLE change (
  revision INTEGER NOT NULL REFERENCES revision (number),
  part_id TEXT NOT NULL CHECK (length(part_id) BETWEEN 1 AND 100),
  before TEXT CHECK (length(before) BETWEEN 1 AND 1000000),  -- NULL: the part did not exist
  PRIMARY KEY (revision, part_id)
) STRICT;
INSERT INTO change VALUES(8,'mine',replace('part,mine,reservoir,me,bottle,user,"from the ""shelf"", 2 pieces"\nnumber,body_volume_ml,600,third_party,\nnumber,internal_volume_ml,500,third_party,user\nnumber,mass_kg,0.1,estimated,guess\nnumber,pressure_max_kpa_gauge,400,datasheet,p. 3\n','\n',char(10)));
INSERT INTO change VALUES(9,'mine',NULL);
INSERT INTO change VALUES(10,'documented',NULL);
CREATE TABLE request_key (
  key TEXT NOT NULL PRIMARY KEY CHECK (length(key) BETWEEN 1 AND 255),
  request TEXT NOT NULL CHECK (length(request) BETWEEN 1 AND 100),
  base INTEGER NOT NULL REFERENCES revision (number),
  revision INTEGER NOT NULL REFERENCES revision (number),
  at TEXT NOT NULL CHECK (length(at) = 20)
) STRICT, WITHOUT ROWID;
CREATE TABLE model (
  name TEXT NOT NULL CHECK (length(name) BETWEEN 1 AND 100 AND name NOT GLOB '*[^a-z0-9._-]*'
    AND name GLOB '[a-z0-9]*' AND name <> 'nominal'),
  version INTEGER NOT NULL CHECK (version BETWEEN 1 AND 9007199254740991),
  at TEXT NOT NULL CHECK (length(at) = 20),
  who TEXT NOT NULL CHECK (length(who) <= 200),
  document TEXT NOT NULL CHECK (length(document) BETWEEN 2 AND 10000000),
  hash TEXT NOT NULL CHECK (length(hash) = 64 AND hash NOT GLOB '*[^0-9a-f]*'),
  PRIMARY KEY (name, version)
) STRICT;
INSERT INTO model VALUES('bench',1,'2026-11-21T08:00:00Z','me','{"schema":"model/1"}','f1bdf58f0e94943274a03ba2ef07f34bd8431c6665303e3e6353d2b7eab445bc');
CREATE TABLE IF NOT EXISTS "part" (
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
INSERT INTO part VALUES('airpo-d028b-15lpm','compressor','Airpo','D028B (12 V), 15 L/min','seed','The source gives 9 to 15 L/min: both ends are listed. Life 500 h, at most 5 h at a time','',NULL);
INSERT INTO part VALUES('documented','reservoir','Maker','D 1','user','','Maker D',1);
INSERT INTO part VALUES('festo-crvzs-0.1','reservoir','Festo','CRVZS-0.1','seed','Volume tolerance 20 % (G1: 10 %).','',NULL);
INSERT INTO part VALUES('generic-barb-3.175mm-m3','fitting','generic','barb for 2 mm bore (3.175 mm tube) x M3','seed','','',NULL);
INSERT INTO part VALUES('mine','reservoir','me','bottle','user','from the "shelf", 2 pieces','',NULL);
CREATE TABLE IF NOT EXISTS "number" (
  part_id TEXT NOT NULL REFERENCES "part" (id) ON DELETE CASCADE,
  field TEXT NOT NULL CHECK (length(field) BETWEEN 1 AND 100),
  value REAL NOT NULL CHECK (value BETWEEN -1e6 AND 1e6),
  provenance TEXT NOT NULL
    CHECK (provenance IN ('datasheet', 'third_party', 'derived', 'estimated', 'measured')),
  source TEXT NOT NULL,
  uncertainty REAL CHECK (uncertainty > 0 AND uncertainty <= 1),  -- NULL: not known
  PRIMARY KEY (part_id, field)
) STRICT, WITHOUT ROWID;
INSERT INTO number VALUES('airpo-d028b-15lpm','body_volume_ml',216.71999999999999886,'estimated','rule: pump body volume, data README',NULL);
INSERT INTO number VALUES('airpo-d028b-15lpm','duty_max',1.0,'estimated','rule: pump duty, data README',NULL);
INSERT INTO number VALUES('airpo-d028b-15lpm','mass_kg',0.21671999999999999597,'estimated','rule: pump mass, data README',NULL);
INSERT INTO number VALUES('airpo-d028b-15lpm','pressure_max_kpa_gauge',150.0,'third_party','https://abra-electronics.com/electromechanical/motors/other-motors/d028b-airpo-vacuum-pump-12v-d028b.html (archived in github.com/sitruklaq/Hattonlab-Pneumatics@8e15200)',NULL);
INSERT INTO number VALUES('airpo-d028b-15lpm','price_eur',17.088000000000000966,'derived','https://abra-electronics.com/electromechanical/motors/other-motors/d028b-airpo-vacuum-pump-12v-d028b.html (archived in github.com/sitruklaq/Hattonlab-Pneumatics@8e15200); 25.13 CAD at 0.68',NULL);
INSERT INTO number VALUES('airpo-d028b-15lpm','voltage_v',12.0,'third_party','https://abra-electronics.com/electromechanical/motors/other-motors/d028b-airpo-vacuum-pump-12v-d028b.html (archived in github.com/sitruklaq/Hattonlab-Pneumatics@8e15200)',NULL);
INSERT INTO number VALUES('documented','body_volume_ml',600.0,'third_party','',NULL);
INSERT INTO number VALUES('documented','internal_volume_ml',500.0,'third_party','user',NULL);
INSERT INTO number VALUES('documented','mass_kg',0.10000000000000000555,'estimated','guess',NULL);
INSERT INTO number VALUES('documented','pressure_max_kpa_gauge',400.0,'datasheet','p. 3',NULL);
INSERT INTO number VALUES('documented','price_eur',6.0,'derived','offer of Shop, 2024-05: 12 EUR for 2',NULL);
INSERT INTO number VALUES('festo-crvzs-0.1','body_volume_ml',165.87999999999999545,'derived','github.com/TFLVerouden/cough-machine-control@e24e8a42 docs/airflow/FESTO_reservoir_CRVS10.pdf; cylinder',NULL);
INSERT INTO number VALUES('festo-crvzs-0.1','internal_volume_ml',100.0,'datasheet','github.com/TFLVerouden/cough-machine-control@e24e8a42 docs/airflow/FESTO_reservoir_CRVS10.pdf',NULL);
INSERT INTO number VALUES('festo-crvzs-0.1','mass_kg',0.22600000000000000643,'datasheet','github.com/TFLVerouden/cough-machine-control@e24e8a42 docs/airflow/FESTO_reservoir_CRVS10.pdf',NULL);
INSERT INTO number VALUES('festo-crvzs-0.1','pressure_max_kpa_gauge',1600.0,'datasheet','github.com/TFLVerouden/cough-machine-control@e24e8a42 docs/airflow/FESTO_reservoir_CRVS10.pdf',NULL);
INSERT INTO number VALUES('generic-barb-3.175mm-m3','body_volume_ml',0.4000000000000000222,'estimated','rule: fitting body volume, data README',NULL);
INSERT INTO number VALUES('generic-barb-3.175mm-m3','critical_ratio',0.5,'estimated','rule: fitting critical ratio, data README',NULL);
INSERT INTO number VALUES('generic-barb-3.175mm-m3','mass_kg',0.0011999999999999998948,'estimated','rule: fitting mass, data README',NULL);
INSERT INTO number VALUES('generic-barb-3.175mm-m3','pressure_max_kpa_gauge',500.0,'estimated','rule: fitting pressure, data README',NULL);
INSERT INTO number VALUES('generic-barb-3.175mm-m3','sonic_conductance_dm3_per_s_bar',0.15204999999999999071,'estimated','rule: fitting C by bore 1.1 mm, data README',NULL);
INSERT INTO number VALUES('generic-barb-3.175mm-m3','tube_outer_diameter_mm',3.1749999999999998223,'estimated','rule: fitting size classes, data README',NULL);
INSERT INTO number VALUES('mine','body_volume_ml',600.0,'third_party','',NULL);
INSERT INTO number VALUES('mine','internal_volume_ml',500.0,'third_party','user',NULL);
INSERT INTO number VALUES('mine','mass_kg',0.10000000000000000555,'estimated','guess',NULL);
INSERT INTO number VALUES('mine','pressure_max_kpa_gauge',400.0,'datasheet','p. 3',NULL);
CREATE TABLE IF NOT EXISTS "text" (
  part_id TEXT NOT NULL REFERENCES "part" (id) ON DELETE CASCADE,
  field TEXT NOT NULL CHECK (length(field) BETWEEN 1 AND 100),
  value TEXT NOT NULL CHECK (length(value) BETWEEN 1 AND 200),
  provenance TEXT NOT NULL
    CHECK (provenance IN ('datasheet', 'third_party', 'derived', 'estimated', 'measured')),
  source TEXT NOT NULL,
  PRIMARY KEY (part_id, field)
) STRICT, WITHOUT ROWID;
INSERT INTO text VALUES('airpo-d028b-15lpm','type','diaphragm','estimated','rule: pump size classes, data README');
INSERT INTO text VALUES('festo-crvzs-0.1','material','stainless steel','datasheet','github.com/TFLVerouden/cough-machine-control@e24e8a42 docs/airflow/FESTO_reservoir_CRVS10.pdf');
INSERT INTO text VALUES('festo-crvzs-0.1','port','1/8','datasheet','github.com/TFLVerouden/cough-machine-control@e24e8a42 docs/airflow/FESTO_reservoir_CRVS10.pdf');
INSERT INTO text VALUES('generic-barb-3.175mm-m3','style','barb','estimated','rule: fitting size classes, data README');
INSERT INTO text VALUES('generic-barb-3.175mm-m3','thread','M3','estimated','rule: fitting size classes, data README');
CREATE TABLE IF NOT EXISTS "curve" (
  part_id TEXT NOT NULL PRIMARY KEY REFERENCES "part" (id) ON DELETE CASCADE,
  free_air_provenance TEXT NOT NULL
    CHECK (free_air_provenance IN ('datasheet', 'third_party', 'derived', 'estimated', 'measured')),
  free_air_source TEXT NOT NULL,
  current_provenance TEXT NOT NULL
    CHECK (current_provenance IN ('datasheet', 'third_party', 'derived', 'estimated', 'measured')),
  current_source TEXT NOT NULL,
  free_air_uncertainty REAL CHECK (free_air_uncertainty > 0 AND free_air_uncertainty <= 1),
  current_uncertainty REAL CHECK (current_uncertainty > 0 AND current_uncertainty <= 1)
) STRICT, WITHOUT ROWID;
INSERT INTO curve VALUES('airpo-d028b-15lpm','estimated','rule: pump flow line, data README','estimated','rule: pump current, data README',NULL,NULL);
CREATE TABLE IF NOT EXISTS "curve_point" (
  part_id TEXT NOT NULL REFERENCES "curve" (part_id) ON DELETE CASCADE,
  pressure_kpa_gauge REAL NOT NULL CHECK (pressure_kpa_gauge BETWEEN -200 AND 5e4),
  free_air_l_per_min REAL NOT NULL CHECK (free_air_l_per_min BETWEEN 0 AND 1e6),
  current_a REAL NOT NULL CHECK (current_a > 0 AND current_a <= 1e3),
  PRIMARY KEY (part_id, pressure_kpa_gauge)
) STRICT, WITHOUT ROWID;
INSERT INTO curve_point VALUES('airpo-d028b-15lpm',0.0,15.0,0.5);
INSERT INTO curve_point VALUES('airpo-d028b-15lpm',15.0,12.878999999999999559,1.0);
INSERT INTO curve_point VALUES('airpo-d028b-15lpm',30.0,6.8606999999999995765,1.0);
INSERT INTO curve_point VALUES('airpo-d028b-15lpm',45.0,4.8444000000000002614,1.0);
INSERT INTO curve_point VALUES('airpo-d028b-15lpm',60.0,3.829800000000000093,1.0);
INSERT INTO curve_point VALUES('airpo-d028b-15lpm',75.0,3.2164999999999999147,1.0);
INSERT INTO curve_point VALUES('airpo-d028b-15lpm',90.0,2.8043999999999997818,1.0);
INSERT INTO curve_point VALUES('airpo-d028b-15lpm',105.0,2.5074999999999998401,1.0);
INSERT INTO curve_point VALUES('airpo-d028b-15lpm',120.0,2.2829000000000001513,1.0);
INSERT INTO curve_point VALUES('airpo-d028b-15lpm',135.0,1.5,1.0);
INSERT INTO curve_point VALUES('airpo-d028b-15lpm',150.0,0.0,1.0);
CREATE TABLE alias (
  part_id TEXT NOT NULL REFERENCES part (id) ON DELETE CASCADE,
  place INTEGER NOT NULL CHECK (place BETWEEN 0 AND 99),
  alias TEXT NOT NULL CHECK (length(alias) BETWEEN 1 AND 200),
  PRIMARY KEY (part_id, place)
) STRICT, WITHOUT ROWID;
INSERT INTO alias VALUES('documented',0,'D-1');
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
INSERT INTO offer VALUES('documented',0,'Shop',12.0,'EUR',2.0,'2024-05','https://example.org/d');
CREATE TABLE document (
  part_id TEXT NOT NULL REFERENCES part (id) ON DELETE CASCADE,
  place INTEGER NOT NULL CHECK (place BETWEEN 0 AND 99),
  link TEXT NOT NULL,
  sha256 TEXT NOT NULL
    CHECK (sha256 = '' OR (length(sha256) = 64 AND sha256 NOT GLOB '*[^0-9a-f]*')),
  PRIMARY KEY (part_id, place)
) STRICT, WITHOUT ROWID;
INSERT INTO document VALUES('documented',0,'https://example.org/d.pdf','');
INSERT INTO document VALUES('documented',1,'recording.csv','ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad');
CREATE INDEX change_by_part ON change (part_id, revision);
CREATE TRIGGER revision_is_not_deleted BEFORE DELETE ON revision
  BEGIN SELECT RAISE(ABORT, 'a revision is never deleted'); END;
CREATE TRIGGER revision_is_not_changed BEFORE UPDATE ON revision WHEN OLD.hash IS NOT NULL
  BEGIN SELECT RAISE(ABORT, 'a revision is never changed'); END;
CREATE TRIGGER change_is_not_deleted BEFORE DELETE ON change
  BEGIN SELECT RAISE(ABORT, 'history is never deleted'); END;
CREATE TRIGGER change_is_not_changed BEFORE UPDATE ON change
  BEGIN SELECT RAISE(ABORT, 'history is never changed'); END;
CREATE INDEX request_key_by_age ON request_key (at);
CREATE TRIGGER model_is_not_deleted BEFORE DELETE ON model
  BEGIN SELECT RAISE(ABORT, 'a model revision is never deleted'); END;
CREATE TRIGGER model_is_not_changed BEFORE UPDATE ON model
  BEGIN SELECT RAISE(ABORT, 'a model revision is never changed'); END;
CREATE INDEX part_by_family ON part (family, id);
COMMIT;
