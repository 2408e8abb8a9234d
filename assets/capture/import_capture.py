"""Opens a RenderDoc capture, lists its shadow maps, and writes chosen ones as a bundle.

Run by Shadow Inspector in a process of its own. Each line of the standard output is one JSON object:
{"progress": 0..1, "label": ...}, {"candidate": ...}, {"note": ...}, {"done": ...} or {"error": ...}.
"""
import argparse
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))


def say(**line):
    print(json.dumps(line, allow_nan=False, default=float), flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("capture")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--pick", type=int, action="append", default=[])
    parser.add_argument("--output")
    options = parser.parse_args()
    try:
        import numpy
    except ImportError:
        say(error="import-capture needs the Debian package python3-numpy; install it", place="program")
        return 1
    try:
        import renderdoc as rd
    except ImportError:
        say(error="import-capture needs the Debian package python3-renderdoc; install it", place="program")
        return 1
    from capture_reading import Capture, CaptureError
    import capture_frame
    try:
        say(progress=0.0, label="opening")
        capture = Capture(options.capture)
        try:
            capture_frame.run(capture, options, say)
        finally:
            capture.close()
            rd.ShutdownReplay()
    except CaptureError as error:
        say(error=str(error), place="capture")
        return 1
    except (AttributeError, IndexError, KeyError, TypeError, ValueError, ArithmeticError,
            numpy.linalg.LinAlgError) as error:
        say(error="cannot be read (%s); capture the frame again, or pick single maps by --list and --pick" % error,
            place="capture")
        return 1
    except MemoryError:
        say(error="takes more memory than import-capture may use", place="capture")
        return 1
    return 0


if __name__ == "__main__":
    status = main()
    sys.stdout.flush()
    sys.stderr.flush()
    # A thread of RenderDoc may still start LLVM here. Destructors that run at the same time wait for it without end.
    os._exit(status)
