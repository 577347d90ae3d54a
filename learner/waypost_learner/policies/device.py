"""Where networks compute: on a CUDA device if there is one, else on the CPU.

Random numbers are always drawn on the CPU, so a seed gives the same numbers everywhere. Floating-point sums still
differ in their last bits between devices.
"""

import torch

from waypost.trajectory import Observation

DEVICE = torch.device("cuda" if torch.cuda.is_available() else "cpu")


def has_bf16() -> bool:
    """Return whether the device supports bf16 arithmetic."""
    if DEVICE.type == "cuda":
        return bool(torch.cuda.is_bf16_supported())
    return bool(torch.ops.mkldnn._is_mkldnn_bf16_supported())


def mixed_precision(enabled: bool) -> torch.autocast:
    """Return a context in which networks compute in bf16, or a context without effect if not `enabled`."""
    return torch.autocast(DEVICE.type, torch.bfloat16, enabled=enabled)


def as_input(observations: Observation) -> torch.Tensor:
    """Return observations as networks see them, float32: uint8 is divided by 255."""
    tensor = torch.from_numpy(observations)
    return tensor.float().div_(255) if tensor.dtype == torch.uint8 else tensor


def to_device(batch: torch.Tensor) -> torch.Tensor:
    """Return a batch on the device. Pictures get the memory layout that is fastest for convolutions."""
    batch = batch.to(DEVICE)
    return batch.contiguous(memory_format=torch.channels_last) if batch.dim() == 4 else batch
