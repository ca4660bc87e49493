// SPDX-License-Identifier: Apache-2.0
// The panels of numbers: position, heading, attitude, depth and motion, surfacing, battery.
import {$, Values, attribute, make, write} from './dom.js';
import {angle, bearing, degrees, duration, number, place, words} from './format.js';
import {Horizon} from './horizon.js';
import {Rose, drawDeviation} from './rose.js';

const NO_NAVIGATION = 'no record of the estimator: navigation.enabled is off, or nothing came yet';

export class Numbers {
  constructor(store) {
    this.store = store;
    this.rose = new Rose();
    this.horizon = new Horizon();
    this.lists = {};
    for (const id of ['position', 'heading-values', 'attitude-values', 'motion-values', 'surfacing-values', 'battery-values']) this.lists[id] = new Values($(id));
  }

  // Heading, radians, with where it comes from, and the estimator's error. The compass speaks more often than the estimator.
  heading() {
    const newest = this.store.best('/compass', 'heading');
    const navigation = this.store.record('/nav')?.message;
    const hasHeading = (record) => (record?.message.heading_calibrated_rad ?? record?.message.heading_rad) != null;
    // One device may send heading and field apart: its newest record with a heading counts for a second.
    if (hasHeading(newest) || newest == null || newest.device !== this.compass?.device || newest.at - this.compass.at > 1000) this.compass = newest;
    const compass = this.compass, m = compass?.message;
    if (hasHeading(compass)) {
      return {rad: m.heading_calibrated_rad ?? m.heading_rad, std: navigation?.heading_std_rad, from: compass.device, isTrue: m.heading_is_true === true, record: compass};
    }
    if (navigation?.heading_rad != null) return {rad: navigation.heading_rad, std: navigation.heading_std_rad, from: 'estimator', isTrue: this.store.record('/health')?.message.earth_field?.declination != null, record: this.store.record('/nav')};
    return null;
  }

  draw() {
    this.#heading();
    this.#attitude();
    this.#position();
    this.#motion();
    this.#surfacing();
    this.#battery();
  }

  #heading() {
    const heading = this.heading();
    const list = this.lists['heading-values'];
    this.rose.heading(heading?.rad, heading?.std);
    const deg = bearing(degrees(heading?.rad));
    write($('heading-value'), deg == null ? 'absent' : number(deg, '\u00b0', 1, heading.std == null ? null : degrees(heading.std)));
    const navigation = this.store.record('/nav')?.message;
    const noError = heading?.std == null ? `, error absent: ${navigation ? 'the estimator has none yet' : NO_NAVIGATION}` : '';
    write($('heading-north'), heading ? (heading.isTrue ? 'true' : 'magnetic') + noError : '');
    const m = heading?.record.topic === '/compass' ? heading.record.message : null;
    const from = this.store.record('/health')?.message.heading_source === 'autopilot' ? "the autopilot's own heading" : m?.calibration ? `calibration ${m.calibration}` : 'no calibration in force';
    list.set('from', heading?.from ?? null, heading ? from : 'no compass delivers a heading');
    const imu = this.store.best('/imu', 'rates')?.message;
    const rate = imu?.yaw_rate_calibrated_rad_s ?? imu?.rate_rad_s?.[2] ?? m?.turn_rate_rad_s ?? null;
    list.set('rate of turn', number(degrees(rate), '\u00b0/s', 1), rate == null ? 'no gyro delivers' : '');
    const calib = this.store.all('/calib').map((record) => record.message);
    if (calib.length > 0 && calib[0] !== this.calibShown) {
      this.calibShown = calib[0];
      this.rose.coverage(calib[0].rose);
      drawDeviation(calib.flatMap((one) => one.calibrators ?? []).find((one) => one.calibrator === 'compass'));
    }
    if (calib.length === 0) {
      this.calibShown = null;
      drawDeviation(null);
    }
  }

  #attitude() {
    const list = this.lists['attitude-values'];
    const m = this.store.best('/compass', 'heading')?.message;
    const navigation = this.store.record('/nav')?.message;
    const [roll, pitch] = m?.roll_rad != null ? [m.roll_rad, m.pitch_rad] : [navigation?.roll_rad, navigation?.pitch_rad];
    this.horizon.show(roll, pitch);
    const std = m?.roll_rad != null ? m.tilt_std_rad : null;
    const reason = 'no inclinometer and no accelerometers deliver';
    list.set('roll', angle(roll, 1, std), roll == null ? reason : m?.tilt_by_accelerometers ? 'by accelerometers' : '');
    list.set('pitch', angle(pitch, 1, std), pitch == null ? reason : '');
  }

  #position() {
    const list = this.lists.position;
    const m = this.store.record('/nav')?.message;
    const gps = this.store.best('/gps', 'position')?.message;
    const known = m?.lat != null;
    const reason = m ? 'there was no fix yet' : NO_NAVIGATION;
    list.set('position', known ? `${place(m.lat, 'N', 'S')}  ${place(m.lon, 'E', 'W')}` : null, known ? '' : reason);
    list.set('standard error', known ? `${number(m.north_std_m, 'm', 1)} north, ${number(m.east_std_m, 'm', 1)} east` : null, known ? '' : reason);
    const since = known && m.position === 'reckoned' ? `${duration(m.since_fix_s)} and ${number(m.since_fix_m, 'm', 0)} since the last fix` : '';
    list.set('by', known ? {fixes: 'fixes', reckoned: 'dead reckoning'}[m.position] ?? words(m.position) : null, known ? since : reason);
    const fix = gps ? `${words(gps.fix)}${gps.tracked != null ? `, ${gps.tracked} satellites tracked` : ''}${gps.dop != null ? `, DOP ${gps.dop.toFixed(1)}` : ''}` : null;
    list.set('receiver', fix, gps ? '' : 'no receiver delivers');
    const set = known ? Math.hypot(m.set_north_m_s ?? 0, m.set_east_m_s ?? 0) : null;
    if (known && m.set_north_m_s != null) list.set('set by current', `${number(set, 'm/s', 2)} towards ${number(bearing(degrees(Math.atan2(m.set_east_m_s, m.set_north_m_s))), '\u00b0', 0)}`, 'learnt at the fixes');
  }

  #motion() {
    const list = this.lists['motion-values'];
    const m = this.store.record('/nav')?.message;
    const imu = this.store.all('/imu').find((record) => record.message.depth_m != null);
    const gauge = this.store.best('/depth', 'depth') ?? imu;
    const depth = gauge?.message.depth_m ?? m?.depth_m;
    list.set('depth', number(depth, 'm', 2, gauge?.message.depth_std_m), depth == null ? 'no depth gauge delivers' : gauge ? `by ${gauge.device}` : 'by the estimator');
    list.set('altitude', number(m?.altitude_m, 'm', 2, m?.altitude_std_m), m?.altitude_m == null ? 'no altimeter or Doppler log, or it is out of range' : '');
    if (m?.water_depth_m != null) list.set('water depth', number(m.water_depth_m, 'm', 1));
    const source = {shaft: 'from the shaft', water: 'Doppler log, through the water', dvl: 'Doppler log, over the bottom'}[m?.speed_source] ?? '';
    list.set('speed', number(m?.speed_m_s, 'm/s', 2), m?.speed_m_s == null ? 'neither shaft speed nor a Doppler log' : source);
    const gps = this.store.best('/gps', 'velocity')?.message;
    list.set('over ground', gps?.speed_m_s == null ? null : `${number(gps.speed_m_s, 'm/s', 2, gps.velocity_std_m_s)} at ${number(bearing(degrees(gps.course_rad)), '\u00b0', 0) ?? 'no course'}`, gps?.speed_m_s == null ? 'no fix' : 'by the receiver');
    const motor = this.store.best('/motor', 'shaft')?.message;
    const none = 'no motor card delivers';
    list.set('shaft', number(motor?.rpm, 'rpm', 0), motor ? `ordered ${number(motor.rpm_commanded, 'rpm', 0) ?? 'absent'}` : none);
    list.set('fins', motor?.fins_rad ? motor.fins_rad.map((rad) => angle(rad, 1)).join('  ') : null, motor ? '' : none);
    list.set('motor current', number(motor?.current_A, 'A', 2, motor?.current_std_A), motor ? '' : none);
    for (const record of this.store.all('/dvl')) {
      const v = record.message.bottom_velocity_m_s;
      list.set(`${record.device}: over the bottom`, v ? v.map((one) => number(one, '', 2)).join('  ') + '\u202fm/s' : null, v ? `${record.message.frame} axes` : 'no bottom lock');
    }
    for (const {message, device} of this.store.all('/sensor')) list.set(`${device}: ${words(message.quantity)}`, number(message.value, message.unit, 3, message.value_std), message.value == null ? 'the sensor gives no value' : '');
  }

  #surfacing() {
    const list = this.lists['surfacing-values'];
    const m = this.store.record('/nav')?.message;
    const hasAdvice = m?.surface_within_s != null;
    const within = hasAdvice ? (m.surface_within_s <= 0 ? 'surface now' : `within ${duration(m.surface_within_s)}`) : null;
    const grade = !hasAdvice ? '' : m.surface_within_s <= 0 ? 'bad' : m.surface_within_s < 60 ? 'warn' : 'good';
    const none = !m ? NO_NAVIGATION : m.lat == null ? 'there was no fix yet' : 'no bound of the error is set (navigation.max_error_m)';
    list.set('antenna out of the water', within, hasAdvice ? 'the ascent takes part of this time' : none, grade);
    list.set('error at the first fix, 95 %', number(m?.predicted_error_m, 'm', 1), m?.predicted_error_m == null ? none : 'if it surfaced now');
    list.set('since the last fix', m?.lat == null ? null : duration(m.since_fix_s), m?.lat == null ? none : number(m.since_fix_m, 'm through the water', 0) ?? '');
  }

  #battery() {
    const list = this.lists['battery-values'];
    const m = this.store.record('/battery')?.message;
    const power = this.store.record('/power')?.message;
    if (!m && !power) {
      list.clear('charge');
      return list.set('charge', null, 'no gauge of a battery delivers, and its charge is not counted');
    }
    const none = m ? 'not known yet' : 'the charge is not counted ([battery])';
    list.set('charge', m?.charge_Ah == null ? null : number(m.charge_Ah, 'Ah', 2, m.charge_std_Ah), m?.charge_Ah == null ? (m ? 'not known yet: battery.full or battery.set tells it' : none) : number(m.charge_percent, '%', 0) ?? '', m?.low ? 'bad' : '');
    list.set('voltage', number(m?.voltage_V ?? power?.voltage_V, 'V', 2), '');
    list.set('current', number(m?.current_A ?? power?.current_A, 'A', 2), m?.current_measured === false ? 'computed, not measured' : '');
    list.set('time left', duration(m?.time_left_s), m?.time_left_s == null ? none : '');
    list.set('range left', number(m?.range_left_m, 'm', 0), m?.range_left_m == null ? none : '');
  }
}
