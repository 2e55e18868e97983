#!/bin/bash
#SBATCH --array=1-60
#SBATCH --cpus-per-task=1
#SBATCH --time=00:10:00
#SBATCH --output=build/array.log --open-mode=append
# Each job of the array renders one part: sbatch docs/machines/array.sh
# When all are done: build/demo08 --samples 1024 --out build/lab.png --join 60
build/demo08 --samples 1024 --out build/lab.png --threads "$SLURM_CPUS_PER_TASK" \
    --part "$SLURM_ARRAY_TASK_ID/60"
