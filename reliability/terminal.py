"""Runs a program in a terminal of its own.

`terminal.py resize PROGRAM...` changes the size of the terminal all the time, down to one column, and ends with the status of the program.
`terminal.py close PROGRAM...` closes the terminal after a moment, and is content if the program was told (status 129) and did not panic.
"""

import fcntl
import os
import pty
import random
import select
import struct
import sys
import termios
import time


def main():
    how, command = sys.argv[1], sys.argv[2:]
    child, terminal = pty.fork()
    if child == 0:
        os.execv(command[0], command)
    begun, shown = time.time(), b""
    while True:
        if how == "resize":
            rows, columns = random.choice([(1, 1), (2, 7), (24, 80), (50, 200), (0, 0), (3, 1000)])
            fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))
        elif time.time() - begun > 0.3:
            os.close(terminal)
            break
        if select.select([terminal], [], [], 0.02)[0]:
            try:
                shown += os.read(terminal, 65536)
            except OSError:
                break
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if b"panicked" in shown:
        print(shown.decode(errors="replace"))
        return 1
    if how == "close":
        print(f"the program ended with status {status}") if status != 129 else None
        return 0 if status == 129 else 1
    return status


sys.exit(main())
