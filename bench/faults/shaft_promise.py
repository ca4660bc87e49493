# SPDX-License-Identifier: Apache-2.0
"""How long the shaft may turn alone: the promise of docs/control.md, and the verdict on it.

The shaft turns alone while it obeys an order that nobody who lives has renewed within timeout_s of its lease; STOP voids all
orders before it. Such a time ends when the card has 0 or when a new order is taken. It must end by the latest of:

- 0.2 s after it began
- 2 s after navcald runs again, which was killed (and is started 1 s after its death, be it in vain) or stopped, or which
  a second signal ended before the card had shown the safe state
- echo_timeout_s + 0.2 s after a line with the safe state that was lost on the wire
- 1.5 s after the port is back

A clean end of navcald excuses nothing, nor does one that the campaign did not bring about (a crash, a start in vain).
"""
REACTION_S, AFTER_RUN_S, AFTER_PORT_S, RESTART_S = 0.2, 2, 1.5, 1
# The machine's part: a fixed one, and three times the delay of the card's own loop meanwhile.
MARGIN_S, MARGIN_OF_STALL = 0.1, 3
FOR_EVER_S = 4  # so long after the promise nobody is expected to do anything any more


class Promise:
    def __init__(self, echo_timeout_s, patience_s):
        self.echo_timeout_s, self.patience_s = echo_timeout_s, patience_s
        self.expires, self.excused, self.outages = float("inf"), 0.0, set()
        self.stall_s = self.stall_before_s = 0.0  # of the card's loop since the beginning, now and when it was last asked
        self.since = None  # the shaft turns alone
        self.times = []  # seconds alone, promised, whether beyond

    def renewed(self, now, timeout_s):
        self.expires = now + timeout_s

    def voided(self, now):
        self.expires = min(self.expires, now)

    def line_lost(self, now):
        self.excused = max(self.excused, now + self.echo_timeout_s + REACTION_S)

    def over(self, outage, now, allowed_s):
        if outage in self.outages:
            self.outages.remove(outage)
            self.excused = max(self.excused, now + allowed_s)

    def deadline(self):
        return float("inf") if self.outages else max(self.since + REACTION_S, self.excused)

    def is_late(self, now, by_s=0):
        margin_s = MARGIN_S + self.patience_s + MARGIN_OF_STALL * (self.stall_s - self.stall_at_since_s)
        return now > self.deadline() + margin_s + by_s

    def look(self, now, turns):
        """To be called often; True when the shaft turns for ever."""
        alone = turns and now > self.expires
        if alone and self.since is None:
            self.since, self.stall_at_since_s, self.broken = self.expires, self.stall_before_s, None
        self.stall_before_s = self.stall_s
        if self.since is None:
            return False
        # What comes after the deadline excuses nothing.
        if self.broken is None and self.is_late(now):
            self.broken = self.deadline()
        for_ever = alone and self.is_late(now, FOR_EVER_S)
        if not alone or for_ever:
            promised = self.broken or self.deadline()
            self.times.append((now - self.since, min(promised, now) - self.since, self.broken is not None))
            self.since = None
        return for_ever
