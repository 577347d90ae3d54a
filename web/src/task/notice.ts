// A notice: one message to the annotator, shown in `NoticeLine.svelte`.
export interface Notice {
  readonly tone: 'info' | 'warning';
  readonly text: string;
}
