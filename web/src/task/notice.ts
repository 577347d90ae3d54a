// A notice: one message to the annotator, in the place kept free for it.
export interface Notice {
  readonly tone: 'info' | 'warning';
  readonly text: string;
}
