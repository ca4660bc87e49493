-- SPDX-License-Identifier: Apache-2.0
PRAGMA page_size=4096;
PRAGMA user_version=1;
CREATE TABLE recordings(recording TEXT PRIMARY KEY, path TEXT NOT NULL, bytes INTEGER NOT NULL) WITHOUT ROWID;
CREATE TABLE vehicles(vehicle TEXT PRIMARY KEY, toml TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE tasks(
  task INTEGER PRIMARY KEY, job TEXT NOT NULL, recording TEXT NOT NULL, vehicle TEXT, configuration TEXT, bank TEXT,
  state TEXT NOT NULL, error TEXT, answer TEXT
);
CREATE TABLE gap(
  task INTEGER PRIMARY KEY, verdict TEXT NOT NULL, sentence TEXT, before REAL, after REAL, floor REAL, closed REAL,
  closed_low REAL, closed_high REAL, heading_error_before_rad REAL, heading_error_after_rad REAL,
  dead_reckoning_before_m_per_100m REAL, dead_reckoning_after_m_per_100m REAL, duration_s REAL
);
CREATE TABLE gap_where(
  task INTEGER, rank INTEGER, channel TEXT, regime TEXT, gap REAL, floor REAL, unit TEXT, p_value REAL,
  PRIMARY KEY(task, rank)
) WITHOUT ROWID;
CREATE TABLE gap_effects(
  task INTEGER, role TEXT, rank INTEGER, effect TEXT, probability REAL, PRIMARY KEY(task, role, rank)
) WITHOUT ROWID;
CREATE TABLE gap_parameters(
  task INTEGER, role TEXT, effect TEXT, parameter TEXT, value REAL, std_error REAL,
  PRIMARY KEY(task, role, effect, parameter)
) WITHOUT ROWID;
CREATE TABLE calibrators(
  task INTEGER, calibrator TEXT, accepted INTEGER, judgement TEXT, reason TEXT, PRIMARY KEY(task, calibrator)
) WITHOUT ROWID;
CREATE TABLE calibration_values(
  task INTEGER, calibrator TEXT, quantity TEXT, value REAL, PRIMARY KEY(task, calibrator, quantity)
) WITHOUT ROWID;
