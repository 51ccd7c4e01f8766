#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Bakes a folder of assets with a Slurm job array, each task its share of the assets:
#   SPA_IN=assets SPA_OUT=maps sbatch --array=1-16 slurm-array.sh [option of spa batch...]
# The folders must be the same on every node. SPA_REPORTS is where the tasks' reports go, one JSON file each; the
# default is $SPA_OUT.reports. Submitted again, or requeued, it bakes what is not up to date yet and nothing twice.
#SBATCH --job-name=spa-batch
#SBATCH --array=1-4
#SBATCH --cpus-per-task=2
#SBATCH --mem=4G
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=spa-batch-%A_%a.log
set -eu
: "${SPA_IN:?is the folder of assets}" "${SPA_OUT:?is the folder to write maps to}"
reports=${SPA_REPORTS:-${SPA_OUT%/}.reports}
mkdir -p "$reports"

# What Slurm gave this task; a cluster that does not hand out memory says none.
set -- --jobs "${SLURM_CPUS_PER_TASK:-1}" "$@"
if [ -n "${SLURM_MEM_PER_NODE-}" ]; then set -- --memory "${SLURM_MEM_PER_NODE}M" "$@"; fi

# exec: what Slurm sends to end a task reaches spa, which then leaves no half a map behind.
exec "${SPA:-spa}" batch "$SPA_IN" -o "$SPA_OUT" --shard auto --report "$reports/$SLURM_ARRAY_TASK_ID.json" "$@"
