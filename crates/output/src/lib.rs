//! What a run leaves behind: ParaView files, probe tables, summary and manifest.
