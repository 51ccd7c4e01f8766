# SPDX-License-Identifier: Apache-2.0
"""check_reports.py ASSETS REPORT...: the reports of all shards of one `spa batch` say that each file below the folder
ASSETS was baked, and by one shard alone."""
import collections
import json
import pathlib
import sys


def main(folder, names):
    reports = [json.loads(pathlib.Path(name).read_text()) for name in names]
    shards = sorted(report["shard"]["index"] % report["shard"]["count"] for report in reports)
    if shards != list(range(len(reports))):
        return f"{len(reports)} reports are of the shards {shards}"
    for name, report in zip(names, reports):
        if any(report["shard"]["count"] != len(reports) for report in reports):
            return f"{name}: {report['shard']['count']} shards, and {len(reports)} reports"
    baked = collections.Counter()
    for name, report in zip(names, reports):
        for asset in report["assets"]:
            if asset["status"] != "baked":
                return f"{name}: {asset['source']} is {asset['status']}"
            baked[asset["source"]] += 1
    wanted = {path.relative_to(folder).as_posix(): 1 for path in pathlib.Path(folder).rglob("*") if path.is_file()}
    if baked != wanted:
        lost, more = wanted.keys() - baked.keys(), {name for name, times in baked.items() if wanted.get(name) != times}
        return f"not in a report: {sorted(lost)}; in too many: {sorted(more)}"
    return None


if __name__ == "__main__":
    if error := main(sys.argv[1], sys.argv[2:]):
        sys.exit(f"check_reports.py: {error}")
