# SPDX-License-Identifier: Apache-2.0
"""The kinds of faults: functions of the case and of a source of random numbers. Some end by an event of their own."""
import os
import shutil
import signal
import subprocess
import time

from faults import shaft_clients as clients


def tool(*command):
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def nothing(case, r):
    pass


def controller_killed(case, r):
    case.kill(case.drive())


def navcald_killed(case, r):
    case.signal(signal.SIGKILL)


def killed_at_first_order(case, r):
    """Within 2 ms of the moment at which a new controller's first order arrives at the card."""
    for driver in case.drivers:
        case.kill(driver)
    first_s = 0.15  # the shortest lease lasts longer
    driver = case.add_driver(first_at=time.monotonic() + first_s)
    victims = r.choice(("controller", "navcald", "controller and navcald"))
    if "controller" in victims:
        case.at(first_s + r.uniform(-0.002, 0.002), case.kill, driver)
    if "navcald" in victims:
        case.at(first_s + r.uniform(-0.002, 0.002), case.signal, signal.SIGKILL)


def navcald_ended(case, r):
    case.signal(r.choice((signal.SIGTERM, signal.SIGINT)))


def controller_stopped(case, r):
    driver = case.drive()
    driver.is_stopped = True
    os.kill(driver.pid, signal.SIGSTOP)

    def go_on():
        driver.is_stopped = False
        if driver.dead_at is None:
            os.kill(driver.pid, signal.SIGCONT)

    case.at(r.uniform(0.1, 6), go_on)


def navcald_stopped(case, r):
    case.signal(signal.SIGSTOP)
    case.at(r.uniform(0.1, 6), case.go_on, case.pid)


def mode(number):
    def change(case, r):
        case.drive().shared[0] = number

    return change


def lines_lost(case, r):
    if r.random() < 0.5:
        case.card.lines_to_lose = r.randrange(1, 4)
    else:
        case.card.is_deaf = True
        case.at(r.uniform(0.1, 1), setattr, case.card, "is_deaf", False)
    r.choice((nothing, controller_killed, navcald_ended))(case, r)


def port_away(case, r):
    case.unplug(r.uniform(0.1, 3))
    r.choice((nothing, controller_killed))(case, r)


def statuses_lost(case, r):
    case.card.is_silent = True
    case.at(r.uniform(0.2, 4), setattr, case.card, "is_silent", False)


def log_folder(case, r):
    note, is_mounted = f"{case.log}/motor.commanded", os.path.ismount(case.log)
    way = r.choice(("gone", "plain file", "note is a folder", "read-only" if is_mounted else "forbidden", "full"))
    case.say(f"log folder: {way}")
    try:
        if way == "read-only":
            # The whole file system cannot be remounted while navcald writes a log there.
            tool("mount", "--bind", case.log, case.log)
            tool("mount", "-o", "remount,bind,ro", case.log)
        elif way == "forbidden":
            os.chmod(case.log, 0)
        elif way == "full" and is_mounted:
            with open(f"{case.log}/filling", "wb", buffering=0) as f:
                while f.write(bytes(4096)):
                    pass
        elif way == "note is a folder":
            if os.path.isfile(note):
                os.unlink(note)
            os.makedirs(f"{note}/x", exist_ok=True)
        elif way != "full":
            if is_mounted:
                tool("umount", "-l", case.log)
            shutil.rmtree(case.log)
            if way == "plain file":
                open(case.log, "w").close()
    except OSError as error:
        case.say(error.strerror)  # a disk is full now, or another fault has been here before
    if r.random() < 0.5:
        case.at(r.uniform(0.05, 0.5), case.signal, signal.SIGKILL)


def configuration(case, r):
    """Broken while navcald runs, which is then killed."""
    text = r.choice((None, "[port.motor", "[command]\nno_such_key = 1\n"))
    case.say(f"configuration: {text!r}")
    case.write_config(text)
    case.signal(signal.SIGKILL)


def takeover(case, r):
    """By a higher priority, which never orders."""
    case.add_driver(priority=r.randrange(2, 10), mode=clients.HANG)


def operator(case, r):
    """`navcal remote` takes over and drives; then it is killed, stopped or ended, or its input is."""
    end, keyboard = os.pipe()  # `end` stays open here, so that typing to a process that has ended is no error
    driver = clients.Driver(case.name, len(case.drivers), priority=10, least_s=1)
    driver.shared[1] = 1 << 40  # it repeats its order
    driver.pid = clients.fork(clients.operator, f"{case.build}/cli/navcal", case.link_port, case.key, driver.timeout_s, end)
    case.keep(driver)
    order = b"order %d 0 0 0\n" % driver.rpm
    for delay_s, words in ((0.6, b"lease\n"), (0.9, order), (1.2, order)):
        case.at(delay_s, os.write, keyboard, words)
    number = r.choice((signal.SIGKILL, signal.SIGSTOP, signal.SIGHUP, signal.SIGINT, None))

    def leave():
        os.close(keyboard)
        if driver.dead_at is None:
            case.say(f"operator {driver.rpm}: {number.name if number else 'end of the input'}")
            os.kill(driver.pid, number or 0)

    case.at(r.uniform(1.3, 2.5), leave)


def status_flood(case, r):
    case.add(clients.reader_of_nothing, case.status_port, r.randrange(2, 30), r.uniform(0.3, 2))


def full_socket(case, r):
    """Idle connections fill the control socket while the drivers hang: STOP must work."""
    case.add(clients.idler, case.path, r.randrange(16, 60))
    for driver in case.drivers:
        driver.shared[0] = clients.HANG
    case.at(r.uniform(0.05, 0.2), case.ask_to_stop)


WITHOUT_DRIVER = {"navcald killed": navcald_killed, "navcald ended": navcald_ended, "navcald stopped": navcald_stopped,
                  "killed at first order": killed_at_first_order, "statuses lost": statuses_lost}
WITH_DRIVER = {"controller killed": controller_killed, "controller stopped": controller_stopped,
               "controller hangs": mode(clients.HANG), "refused orders": mode(clients.REFUSED),
               "leases only": mode(clients.LEASES), "flood of lines": mode(clients.FLOOD), "lines lost": lines_lost,
               "port away": port_away, "log folder": log_folder, "configuration": configuration, "takeover": takeover,
               "operator": operator, "status flood": status_flood, "full socket": full_socket}
FAULTS = WITHOUT_DRIVER | WITH_DRIVER
