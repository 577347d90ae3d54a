"""Where networks compute: on a CUDA device if there is one, else on the CPU.

Random numbers are always drawn on the CPU, so a seed gives the same numbers everywhere. Floating-point sums still
differ in their last bits between devices. On one device they are the same each time.
"""

import os

import torch
from torch import nn

from waypost.trajectory import Observation

DEVICE = torch.device("cuda" if torch.cuda.is_available() else "cpu")

if DEVICE.type == "cuda":  # by default, many sums on CUDA depend on the order in which threads happen to end
    os.environ.setdefault("CUBLAS_WORKSPACE_CONFIG", ":4096:8")  # cuBLAS wants this for sums that are always the same
    torch.use_deterministic_algorithms(True, warn_only=True)
    # New memory that nothing reads before it is written need not be filled.
    torch.utils.deterministic.fill_uninitialized_memory = False  # type: ignore[attr-defined]  # torch's types lack it


def has_bf16() -> bool:
    """Return whether the device computes faster in bf16 than in float32.

    Of the processors with the instruction set x86, those with AMX do, and those of AMD with AVX-512 BF16. Intel's
    AVX-512 BF16 without AMX, as in many virtual machines, makes training slower, and so does bf16 emulated without it.
    """
    if DEVICE.type == "cuda":
        return bool(torch.cuda.is_bf16_supported())
    has = torch.cpu.get_capabilities()
    if has["architecture"] == "x86_64":
        return bool(has["amx_bf16"] or (has["avx512_bf16"] and not has["cpu_name"].startswith("Intel")))
    return bool(torch.ops.mkldnn._is_mkldnn_bf16_supported())


def mixed_precision(enabled: bool) -> torch.autocast:
    """Return a context in which networks compute in bf16, or a context without effect if not `enabled`."""
    return torch.autocast(DEVICE.type, torch.bfloat16, enabled=enabled)


def as_input(observations: Observation) -> torch.Tensor:
    """Return observations as networks see them, float32 on the device: uint8 is divided by 255."""
    tensor = torch.from_numpy(observations).to(DEVICE)  # first: bytes are a quarter of what floats are
    return tensor.float().div_(255) if tensor.dtype == torch.uint8 else tensor


def draw_weights(layer: nn.Conv2d | nn.Linear, rng: torch.Generator) -> None:
    """Give a layer on any device new weights, drawn uniformly (Glorot and Bengio 2010), and biases of 0."""
    drawn = nn.init.xavier_uniform_(torch.empty_like(layer.weight, device="cpu"), generator=rng)
    with torch.no_grad():
        layer.weight.copy_(drawn)
        if layer.bias is not None:
            layer.bias.zero_()


def to_device(batch: torch.Tensor) -> torch.Tensor:
    """Return a batch on the device. Pictures get the memory layout that is fastest for convolutions."""
    batch = batch.to(DEVICE)
    return batch.contiguous(memory_format=torch.channels_last) if batch.dim() == 4 else batch
