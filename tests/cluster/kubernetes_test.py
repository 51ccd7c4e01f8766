# SPDX-License-Identifier: Apache-2.0
"""kubernetes_test.py SPA MANIFEST: does on this machine what Kubernetes does with the Job of MANIFEST, as far as spa can
tell: each index's command with the environment that the manifest gives it, all at once, its volumes being folders. The
maps must be those of one run of `spa batch`, byte for byte."""
import filecmp
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import yaml

import check_reports

UNITS = {"": 1, "Ki": 1 << 10, "Mi": 1 << 20, "Gi": 1 << 30}


def quantity(text):
    """Of a resource, as a number: "2", "500m", "4Gi"."""
    number, unit = re.fullmatch(r"([0-9.]+)(m|[KMG]i|)", str(text)).groups()
    return float(number) / 1000 if unit == "m" else float(number) * UNITS[unit]


def environment(container, index):
    """Of the pod with that index."""
    variables = {"JOB_COMPLETION_INDEX": str(index)}
    for entry in container["env"]:
        value = entry.get("value")
        if value is None:
            kind, resource = entry["valueFrom"]["resourceFieldRef"]["resource"].split(".")
            value = str(math.ceil(quantity(container["resources"][kind][resource])))
        assert isinstance(value, str), f"{entry['name']}: Kubernetes takes strings alone"
        variables[entry["name"]] = value
    return variables


def expanded(text, variables):
    """Kubernetes leaves a variable that it does not know as it is; here that is an error."""
    return re.sub(r"\$\((\w+)\)", lambda match: variables[match[1]], text)


def write_assets(spa, folder):
    for name in ("cube", "sphere", "torus", "cliff"):
        for place in ("props/small", "props/large", "rocks"):
            (folder / place).mkdir(parents=True, exist_ok=True)
            subprocess.run([spa, "sample", name, "--level", "1", "-o", folder / place / f"{name}.glb"], check=True,
                           stdout=subprocess.DEVNULL)


def files(folder):
    return {path.relative_to(folder) for path in folder.rglob("*") if path.is_file()}


def main(spa, manifest):
    job = yaml.safe_load(pathlib.Path(manifest).read_text())
    assert (job["apiVersion"], job["kind"]) == ("batch/v1", "Job")
    spec = job["spec"]
    assert spec["completionMode"] == "Indexed"
    pod = spec["template"]["spec"]
    (container,) = pod["containers"]
    assert {volume["name"] for volume in pod["volumes"]} == {mount["name"] for mount in container["volumeMounts"]}
    assert container["securityContext"]["readOnlyRootFilesystem"]

    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        places = {}
        for mount in container["volumeMounts"]:
            places[mount["mountPath"]] = folder / mount["name"]
            places[mount["mountPath"]].mkdir()
        assets = places["/assets"]
        write_assets(spa, assets)

        def placed(argument):
            """The argument with the folder that stands for the volume it names."""
            mounts = "|".join(map(re.escape, places))
            return re.sub(rf"(^|=)({mounts})(?=/|$)", lambda match: f"{match[1]}{places[match[2]]}", argument)

        runs = []
        for index in range(spec["completions"]):
            variables = environment(container, index)
            command = [placed(expanded(argument, variables)) for argument in container["command"]]
            assert command[0] == "spa"
            runs.append(subprocess.Popen([*command, "--size", "32"], executable=spa, env=variables))
        statuses = [run.wait() for run in runs]
        assert not any(statuses), f"exit statuses {statuses}"

        maps, whole = places["/data"] / "maps", folder / "whole"
        subprocess.run([spa, "batch", assets, "-o", whole, "--size", "32", "--quiet"], check=True)
        differing = sorted(map(str, files(maps) ^ files(whole)))
        assert not differing, f"baked by the pods alone or by one run alone: {', '.join(differing)}"
        for name in sorted(files(whole)):
            assert filecmp.cmp(maps / name, whole / name, shallow=False), f"{name}: not the bytes of one run"
        return check_reports.main(assets, sorted(places["/data"].glob("*.json")))


if __name__ == "__main__":
    if error := main(os.path.abspath(sys.argv[1]), sys.argv[2]):
        sys.exit(f"kubernetes_test.py: {error}")
