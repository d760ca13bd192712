#!/usr/bin/env python3
"""A machine behind a pseudo-terminal that answers each line like Marlin. Writes the port's path, then each command."""
import os
import pty
import re
import time
import tty

LINE_TIME = 0.003  # s

controller, port = pty.openpty()
tty.setraw(port)  # held open: the line does not end between two programs
print(os.ttyname(port), flush=True)
nozzle = bed = 0
waiting = b""
while True:
    waiting += os.read(controller, 4096)
    *lines, waiting = waiting.split(b"\n")
    for line in lines:
        command = re.sub(r"^N-?\d+ *|\*\d+$", "", line.decode("ascii", "replace").strip())
        print(command, flush=True)
        target = re.search(r"^(M104|M109|M140|M190) .*S(\d+)", command)
        if target and target[1] in ("M104", "M109"):
            nozzle = int(target[2])
        elif target:
            bed = int(target[2])
        answer = "ok"
        if command == "M105":
            answer = f"ok T:{nozzle}.0 /{nozzle}.0 B:{bed}.0 /{bed}.0 @:0 B@:0"
        elif command == "M115":
            answer = "FIRMWARE_NAME:Marlin 2.1.2 (test)\nCap:EMERGENCY_PARSER:0\nok"
        time.sleep(LINE_TIME)
        os.write(controller, (answer + "\n").encode())
