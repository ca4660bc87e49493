# SPDX-License-Identifier: Apache-2.0
"""One case, as a process: the card, navcald as systemd would run it, its clients, and faults drawn by a seed."""
import fcntl
import heapq
import itertools
import json
import os
import random
import signal
import socket
import sys
import time

from faults import shaft_clients as clients
from faults.shaft_card import Card
from faults.shaft_faults import FAULTS, WITH_DRIVER, tool
from faults.shaft_promise import AFTER_PORT_S, AFTER_RUN_S, MARGIN_OF_STALL, RESTART_S, Promise

TICK_S = 0.01
LEAD_S = 0.3  # so long before a fault its driver is started
STANDS_S = 0.7  # the case is over when the shaft has stood so long
LONGEST_S = 60  # and what the machine needs
LAST_WORDS = 20  # lines of navcald's that a shaft turning for ever is told with
GIVEN_UP = (2, 3)  # RestartPreventExitStatus of the unit


class Case:
    def __init__(self, seed, number, only, folder, build, may_mount, patience_s):
        self.folder, self.build, self.name, self.begin = folder, build, f"{seed}/{number}", time.monotonic()
        self.log, self.path, self.key, self.config = (f"{folder}/{n}" for n in ("log", "control", "key", "navcald.toml"))
        rng = self.rng = random.Random(self.name)
        others = (only, "controller killed", "navcald killed", "navcald ended") if only else list(FAULTS)
        self.kinds = [only or others[number % len(others)], *rng.choices(others, k=rng.randrange(1, 5))]
        if not only:
            rng.shuffle(self.kinds)
        self.promise = Promise(rng.choice((0.2, 0.5, 1)), patience_s)
        self.drivers, self.others, self.problems, self.timeline = [], [], [], []
        self.events, self.numbers = [], itertools.count()
        self.has_begun = self.is_over = False
        self.zero_at = 0.0  # when the card last heard the safe state
        self.pid = self.stop = None
        os.mkdir(self.log)
        if may_mount:
            tool("mount", "-t", "tmpfs", "-o", "size=2m", "tmpfs", self.log)
        self.make_sockets()
        with open(os.open(self.key, os.O_CREAT | os.O_WRONLY, 0o600), "w") as f:
            f.write(f"{rng.getrandbits(256):064x}\n")
        self.good_config = (f'[log]\ndirectory = "{self.log}"\nfree_floor_MB = 0\n[command]\nslew_rpm_s = 0\n'
                            f'echo_timeout_s = {self.promise.echo_timeout_s}\n[remote]\nlisten = "127.0.0.1:{self.link_port}"\n'
                            f'key_file = "{self.key}"\n[port.motor]\nprotocol = "motor-card"\npath = "{folder}/motor"\n')
        self.write_config(self.good_config)
        self.card = Card(folder, self.on_line)

    def run(self):
        self.start()
        self.drive()
        never = self.loop()
        return {"kinds": self.kinds, "times": self.promise.times, "problems": self.problems, "never": never,
                "stall_s": self.promise.stall_s, "timeline": self.timeline}

    def loop(self):
        """True when the shaft turns for ever."""
        stood_at = top = time.monotonic()
        while True:
            # The last 2 ms before an event are spent asking: for some events a tenth of that counts.
            left_s = self.events[0][0] - top - 0.002 if self.events else TICK_S
            self.card.run(min(TICK_S, max(0, left_s)))
            while self.events and self.events[0][0] <= time.monotonic():
                *_, act, arguments = heapq.heappop(self.events)
                act(*arguments)
            self.reap()
            self.watch_stop()
            now = time.monotonic()
            self.promise.stall_s += max(0, now - top - 1.5 * TICK_S)
            top = now
            if self.promise.look(now, self.card.rpm != 0):
                self.say(f"the shaft turns with {self.card.rpm} and nobody will stop it")
                self.say_last_words()
                return True
            if self.card.rpm or self.events or self.promise.outages or not self.is_over:
                stood_at = now
            if now - stood_at > STANDS_S:
                return False
            if now - self.begin > LONGEST_S + self.promise.patience_s + MARGIN_OF_STALL * self.promise.stall_s:
                self.problems.append("the case does not end")
                return False

    def at(self, delay_s, act, *arguments):
        heapq.heappush(self.events, (time.monotonic() + delay_s, next(self.numbers), act, arguments))

    def say(self, words):
        self.timeline.append(f"{time.monotonic() - self.begin:7.3f} s  {words}")

    def say_last_words(self):
        """What is found out about navcald after the case, whose folder goes with it."""
        with open(f"{self.folder}/navcald.out", errors="replace") as f:
            self.timeline += [f"  navcald: {line.rstrip()}" for line in f.readlines()[-LAST_WORDS:]]
        if self.pid:
            with open(f"/proc/{self.pid}/status") as f:
                self.timeline += [f"  navcald: {line.rstrip()}" for line in f if line.startswith(("State", "Threads"))]

    def plan_faults(self):
        at_s = 0.0
        for kind in self.kinds:
            r = random.Random(self.rng.random())
            at_s += LEAD_S + r.choice((0.02, r.uniform(0, 1.5)))
            if kind in WITH_DRIVER or r.random() < 0.6:
                self.at(at_s - LEAD_S, self.drive)
            self.at(at_s, self.inject, kind, r)
        self.at(at_s + self.rng.uniform(0.1, 1.5), self.everybody_leaves)

    def inject(self, kind, r):
        self.say(f"-- {kind}")
        FAULTS[kind](self, r)

    # navcald: its sockets and its restarts are systemd's

    def make_sockets(self):
        self.sockets = [socket.socket(), socket.socket(socket.AF_UNIX)]
        self.sockets[0].bind(("127.0.0.1", 0))
        self.sockets[1].bind(self.path)
        for s in self.sockets:
            s.listen(128)
        # Bound, and not listening: navcald may listen there, and nobody else is given this port.
        self.reserved = socket.socket()
        self.reserved.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.reserved.bind(("127.0.0.1", 0))
        self.status_port, self.link_port = self.sockets[0].getsockname()[1], self.reserved.getsockname()[1]

    def write_config(self, text):
        if os.path.exists(self.config):
            os.unlink(self.config)
        if text:
            with open(self.config, "w") as f:
                f.write(text)

    def start(self):
        self.say("navcald starts")
        self.pid, self.was_killed, self.is_ending = clients.fork(self.become_navcald), False, False
        self.promise.over("navcald", time.monotonic(), AFTER_RUN_S)

    def become_navcald(self):
        handed_over = [fcntl.fcntl(s.fileno(), fcntl.F_DUPFD_CLOEXEC, 10) for s in self.sockets]
        out = os.open(f"{self.folder}/navcald.out", os.O_CREAT | os.O_APPEND | os.O_WRONLY)
        for fd, to in ((out, 1), (out, 2), (handed_over[0], 3), (handed_over[1], 4)):
            os.dup2(fd, to)
        program = os.environ.get("NAVCALD") or f"{self.build}/daemon/navcald"
        os.execve(program, [program, "--config", self.config],
                  {**os.environ, "LISTEN_FDS": "2", "LISTEN_PID": str(os.getpid())})

    def reap(self):
        pid, status = os.waitpid(self.pid, os.WNOHANG) if self.pid else (0, 0)
        if not pid:
            return
        self.pid, code = None, os.waitstatus_to_exitcode(status)
        self.say(f"navcald has ended: {code}")
        if code == 0 or code in GIVEN_UP:
            self.promise.outages.discard("navcald")
            return self.at(0.3, self.start_by_hand)
        if -code in (signal.SIGTERM, signal.SIGINT):
            self.promise.outages.add("navcald")  # it was too young to catch it: as if killed
        self.at(RESTART_S, self.start)

    def start_by_hand(self):
        """With a good configuration; only when the shaft stands, since nobody would come because it turns."""
        if self.card.rpm:
            return self.at(0.1, self.start_by_hand)
        self.write_config(self.good_config)
        self.start()

    def signal(self, number):
        if not self.pid:
            return
        self.say(f"navcald gets {number.name}")
        self.was_killed = self.was_killed or number == signal.SIGKILL
        is_end = number in (signal.SIGTERM, signal.SIGINT)
        if number in (signal.SIGKILL, signal.SIGSTOP) or (is_end and self.is_ending):
            self.promise.outages.add("navcald")
        self.is_ending = self.is_ending or is_end
        os.kill(self.pid, number)

    def go_on(self, pid):
        if self.pid and self.pid == pid and not self.was_killed:
            self.signal(signal.SIGCONT)
            self.promise.over("navcald", time.monotonic(), AFTER_RUN_S)

    # the card

    def on_line(self, now, rpm, heard):
        if rpm != self.card.rpm or not heard:
            self.say(f"order {rpm}{'' if heard else ', lost'}")
        if rpm == 0:
            if not heard:
                self.promise.line_lost(now)
            else:
                self.zero_at = now
            return
        if not self.has_begun:
            self.has_begun = True
            self.plan_faults()
        driver = next((d for d in self.drivers if d.rpm == rpm), None)
        if driver is None:
            return self.problems.append(f"an order {rpm} that nobody gave")
        driver.seen += 1
        if driver.dead_at is not None and now > driver.dead_at + 0.05:
            self.say(f"order {rpm} of a dead controller")
        elif driver.seen > driver.shared[1]:
            self.say(f"order {rpm} again, which was given {driver.shared[1]} times")
        else:
            self.promise.renewed(now, driver.timeout_s)

    def unplug(self, seconds):
        if self.card.pty:
            self.promise.outages.add("port")
            self.card.unplug()
            self.at(seconds, self.plug)

    def plug(self):
        self.say("the port is back")
        self.card.plug()
        self.promise.over("port", time.monotonic(), AFTER_PORT_S)

    # clients

    def drive(self):
        """Sees to it that somebody drives; who."""
        return next((d for d in self.drivers if d.is_driving()), None) or self.add_driver()

    def add_driver(self, **options):
        driver = clients.Driver(self.name, len(self.drivers), **options)
        driver.pid = clients.fork(clients.controller, self.path, driver)
        return self.keep(driver)

    def keep(self, driver):
        self.drivers.append(driver)
        self.say(f"controller {driver.rpm}: time-out {driver.timeout_s} s, {driver.rate_Hz:.1f} Hz, priority {driver.priority}")
        return driver

    def add(self, work, *arguments):
        self.others.append(clients.fork(work, *arguments))

    def kill(self, driver):
        if driver.dead_at is None:
            self.say(f"controller {driver.rpm} is killed")
            self.card.run(0)  # what has arrived until now is of a living one
            os.kill(driver.pid, signal.SIGKILL)
            os.waitpid(driver.pid, 0)
            driver.dead_at = time.monotonic()

    def everybody_leaves(self):
        self.say("-- everybody leaves")
        self.is_over = True
        for driver in self.drivers:
            self.kill(driver)
        for pid in self.others:
            os.kill(pid, signal.SIGKILL)

    def ask_to_stop(self):
        self.stop, self.stop_pid = clients.shared_words(), self.pid
        self.add(clients.stopper, self.path, self.stop)

    def watch_stop(self):
        if not self.stop or not self.stop[1]:
            return
        done = self.stop[1] == clients.DONE
        self.say(f"STOP: {'done' if done else 'not done'}")
        asked = (self.stop[0] or time.monotonic_ns()) / 1e9
        has_stood = self.zero_at > asked  # what came after that is a new lease's
        if not has_stood:
            self.promise.voided(asked)
        # A navcald that was told to end hangs up, and stops the shaft itself.
        could = self.pid and self.pid == self.stop_pid and not self.is_ending and not self.promise.outages
        if could and not done and not has_stood:
            self.problems.append("STOP was refused")
        self.stop = None


if __name__ == "__main__":
    clients.die_with(int(sys.argv[1]))
    print(json.dumps(Case(**json.loads(sys.argv[2])).run()))
