#!/usr/bin/env python3
"""What Intel's Open Image Denoise makes of the picture that "bench denoise SAMPLES FILE" wrote.

  oidn.py FILE [split]

prints error and seconds: of the whole picture with its albedo and normals, or of the light alone
that comes by way of other surfaces, without its albedo, put together again. On all cores.
"""
import sys, time
import numpy as np
from pyoidn.denoise import denoise

WIDTH, HEIGHT = 640, 480
data = np.fromfile(sys.argv[1], np.float32).reshape(HEIGHT, WIDTH, 5, 3)
exact, noisy, normal, albedo, direct = [np.ascontiguousarray(data[:, :, k]) for k in range(5)]
split = len(sys.argv) > 2
light = np.maximum((noisy - direct) / (albedo + 1e-4), 0) if split else noisy
best = float("inf")
for run in range(4):                    # the first one loads the weights
    start = time.perf_counter()
    clean = denoise(light, albedo, normal, hdr=True)
    best = min(best, time.perf_counter() - start)
if split:
    clean = clean * (albedo + 1e-4) + direct
error = np.sqrt(((clean - exact) ** 2).mean()) / exact.mean()
print(f"{error:.5f}\t{best:.4f}")
