"""Where networks compute: on a CUDA device if there is one, else on the processor.

Random numbers are always drawn on the processor, so that a seed means the same everywhere; sums are not, bit by bit.
"""

import torch

DEVICE = torch.device("cuda" if torch.cuda.is_available() else "cpu")


def has_bf16() -> bool:
    """Return whether the device has arithmetic for bf16."""
    if DEVICE.type == "cuda":
        return bool(torch.cuda.is_bf16_supported())
    return bool(torch.ops.mkldnn._is_mkldnn_bf16_supported())


def mixed_precision(enabled: bool) -> torch.autocast:
    """Return the context in which a network computes in bf16, if so."""
    return torch.autocast(DEVICE.type, torch.bfloat16, enabled=enabled)


def laid_out(batch: torch.Tensor) -> torch.Tensor:
    """Bring a batch to the device, pictures as the convolutions like them best."""
    batch = batch.to(DEVICE)
    return batch.contiguous(memory_format=torch.channels_last) if batch.dim() == 4 else batch
