; From route_search.cpp, SHA-256 b477ce411cefce44eedcb15cafeeede618ae2eaa75423c66da648d58649850f8, by tools/native.py. Do not edit.

%struct.Point = type { <16 x float>, <16 x float>, <16 x float> }
%struct.Motion = type { [17 x float], [17 x float], [136 x float], [136 x float] }
%struct.Frame = type { [9 x <16 x float>], [3 x <16 x float>] }
%struct.Joint = type { [9 x float], [3 x float], float }
%struct.Sphere = type { float, float, float, float }
%struct.Object = type { [9 x float], [3 x float], [3 x float], float, float, float }
%struct.LinkPair = type { i64, i64, i64, i64 }
%struct.Part = type { [3 x float], [3 x float], float, float }
%struct.PartPair = type { i64, i64 }
%struct.Point.4 = type { <8 x double>, <8 x double>, <8 x double> }
%struct.Motion.1 = type { [17 x double], [17 x double], [136 x double], [136 x double] }
%struct.Piece = type { double, double }
%struct.Frame.2 = type { [9 x <8 x double>], [3 x <8 x double>] }
%struct.Joint.3 = type { [9 x double], [3 x double], double }
%struct.Sphere.5 = type { double, double, double, double }
%struct.Object.6 = type { [9 x double], [3 x double], [3 x double], double, double, double }
%struct.Part.7 = type { [3 x double], [3 x double], double, double }
%struct.Tree = type { ptr, ptr, i64 }
%struct.Random = type { i64 }

define void @check_edges(ptr nocapture noundef readonly %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, i64 noundef %3, float noundef %4, float noundef %5, ptr nocapture noundef writeonly %6) {
  %8 = icmp sgt i64 %3, 0
  br i1 %8, label %10, label %9

9:
  ret void

10:
  %11 = phi i64 [ %19, %10 ], [ 0, %7 ]
  %12 = load i64, ptr %0, align 8
  %13 = mul nsw i64 %12, %11
  %14 = getelementptr inbounds float, ptr %1, i64 %13
  %15 = getelementptr inbounds float, ptr %2, i64 %13
  %16 = tail call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef %14, ptr noundef %15, float noundef %4, float noundef %5)
  %17 = zext i1 %16 to i8
  %18 = getelementptr inbounds i8, ptr %6, i64 %11
  store i8 %17, ptr %18, align 1
  %19 = add nuw nsw i64 %11, 1
  %20 = icmp eq i64 %19, %3
  br i1 %20, label %9, label %10
}

declare void @llvm.lifetime.start.p0(i64 immarg, ptr nocapture)

define internal fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr nocapture noundef nonnull readonly align 8 dereferenceable(136) %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, float noundef %3, float noundef %4) unnamed_addr {
  %6 = alloca [192 x %struct.Point], align 64
  %7 = alloca [2 x i64], align 16
  %8 = alloca [9 x <16 x float>], align 64
  %9 = alloca %struct.Motion, align 4
  %10 = alloca [16 x float], align 16
  %11 = alloca [17 x %struct.Frame], align 64
  call void @llvm.lifetime.start.p0(i64 1224, ptr nonnull %9)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %10)
  call void @llvm.memset.p0.i64(ptr noundef nonnull align 16 dereferenceable(64) %10, i8 0, i64 64, i1 false)
  %12 = load i64, ptr %0, align 8
  %13 = icmp slt i64 %12, 0
  br i1 %13, label %19, label %14

14:
  %15 = getelementptr inbounds i8, ptr %0, i64 112
  %16 = icmp eq i64 %12, 0
  %17 = getelementptr inbounds i8, ptr %9, i64 68
  %18 = load ptr, ptr %15, align 8
  br label %29

19:
  %20 = getelementptr inbounds i8, ptr %0, i64 16
  %21 = load i64, ptr %20, align 8
  %22 = icmp sgt i64 %21, 0
  br i1 %22, label %23, label %111

23:
  %24 = getelementptr inbounds i8, ptr %0, i64 120
  %25 = icmp sgt i64 %12, 0
  %26 = getelementptr inbounds i8, ptr %9, i64 136
  %27 = getelementptr inbounds i8, ptr %9, i64 680
  %28 = load ptr, ptr %24, align 8
  br label %70

29:
  %30 = phi i64 [ 0, %14 ], [ %68, %65 ]
  %31 = mul nuw nsw i64 %30, %12
  %32 = getelementptr inbounds float, ptr %18, i64 %31
  br i1 %16, label %33, label %35

33:
  %34 = getelementptr inbounds [17 x float], ptr %9, i64 0, i64 %30
  store float 0.000000e+00, ptr %34, align 4
  br label %65

35:
  %36 = phi i64 [ %47, %35 ], [ 0, %29 ]
  %37 = phi float [ %46, %35 ], [ 0.000000e+00, %29 ]
  %38 = getelementptr inbounds float, ptr %32, i64 %36
  %39 = load float, ptr %38, align 4
  %40 = getelementptr inbounds float, ptr %2, i64 %36
  %41 = load float, ptr %40, align 4
  %42 = fcmp contract olt float %41, 0.000000e+00
  %43 = fneg contract float %41
  %44 = select contract i1 %42, float %43, float %41
  %45 = fmul contract float %39, %44
  %46 = fadd contract float %37, %45
  %47 = add nuw nsw i64 %36, 1
  %48 = icmp eq i64 %47, %12
  br i1 %48, label %49, label %35

49:
  %50 = getelementptr inbounds [17 x float], ptr %9, i64 0, i64 %30
  store float %46, ptr %50, align 4
  br label %51

51:
  %52 = phi i64 [ %63, %51 ], [ 0, %49 ]
  %53 = phi float [ %62, %51 ], [ 0.000000e+00, %49 ]
  %54 = getelementptr inbounds float, ptr %32, i64 %52
  %55 = load float, ptr %54, align 4
  %56 = getelementptr inbounds float, ptr %10, i64 %52
  %57 = load float, ptr %56, align 4
  %58 = fcmp contract olt float %57, 0.000000e+00
  %59 = fneg contract float %57
  %60 = select contract i1 %58, float %59, float %57
  %61 = fmul contract float %55, %60
  %62 = fadd contract float %53, %61
  %63 = add nuw nsw i64 %52, 1
  %64 = icmp eq i64 %63, %12
  br i1 %64, label %65, label %51

65:
  %66 = phi float [ 0.000000e+00, %33 ], [ %62, %51 ]
  %67 = getelementptr inbounds [17 x float], ptr %17, i64 0, i64 %30
  store float %66, ptr %67, align 4
  %68 = add nuw i64 %30, 1
  %69 = icmp eq i64 %30, %12
  br i1 %69, label %19, label %29

70:
  %71 = phi i64 [ 0, %23 ], [ %109, %106 ]
  %72 = mul nsw i64 %71, %12
  %73 = getelementptr inbounds float, ptr %28, i64 %72
  br i1 %25, label %76, label %74

74:
  %75 = getelementptr inbounds [136 x float], ptr %26, i64 0, i64 %71
  store float 0.000000e+00, ptr %75, align 4
  br label %106

76:
  %77 = phi i64 [ %88, %76 ], [ 0, %70 ]
  %78 = phi float [ %87, %76 ], [ 0.000000e+00, %70 ]
  %79 = getelementptr inbounds float, ptr %73, i64 %77
  %80 = load float, ptr %79, align 4
  %81 = getelementptr inbounds float, ptr %2, i64 %77
  %82 = load float, ptr %81, align 4
  %83 = fcmp contract olt float %82, 0.000000e+00
  %84 = fneg contract float %82
  %85 = select contract i1 %83, float %84, float %82
  %86 = fmul contract float %80, %85
  %87 = fadd contract float %78, %86
  %88 = add nuw nsw i64 %77, 1
  %89 = icmp eq i64 %88, %12
  br i1 %89, label %90, label %76

90:
  %91 = getelementptr inbounds [136 x float], ptr %26, i64 0, i64 %71
  store float %87, ptr %91, align 4
  br label %92

92:
  %93 = phi i64 [ %104, %92 ], [ 0, %90 ]
  %94 = phi float [ %103, %92 ], [ 0.000000e+00, %90 ]
  %95 = getelementptr inbounds float, ptr %73, i64 %93
  %96 = load float, ptr %95, align 4
  %97 = getelementptr inbounds float, ptr %10, i64 %93
  %98 = load float, ptr %97, align 4
  %99 = fcmp contract olt float %98, 0.000000e+00
  %100 = fneg contract float %98
  %101 = select contract i1 %99, float %100, float %98
  %102 = fmul contract float %96, %101
  %103 = fadd contract float %94, %102
  %104 = add nuw nsw i64 %93, 1
  %105 = icmp eq i64 %104, %12
  br i1 %105, label %106, label %92

106:
  %107 = phi float [ 0.000000e+00, %74 ], [ %103, %92 ]
  %108 = getelementptr inbounds [136 x float], ptr %27, i64 0, i64 %71
  store float %107, ptr %108, align 4
  %109 = add nuw nsw i64 %71, 1
  %110 = icmp eq i64 %109, %21
  br i1 %110, label %111, label %70

111:
  br label %112

112:
  %113 = phi i64 [ %115, %112 ], [ 68, %111 ]
  %114 = getelementptr inbounds i8, ptr %9, i64 %113
  store float %4, ptr %114, align 4
  %115 = add nuw nsw i64 %113, 4
  %116 = icmp eq i64 %115, 136
  br i1 %116, label %148, label %112

117:
  br i1 %13, label %118, label %122

118:
  %119 = phi float [ 0.000000e+00, %117 ], [ %128, %122 ]
  br i1 %22, label %120, label %140

120:
  %121 = getelementptr inbounds i8, ptr %9, i64 136
  br label %131

122:
  %123 = phi i64 [ %129, %122 ], [ 0, %117 ]
  %124 = phi float [ %128, %122 ], [ 0.000000e+00, %117 ]
  %125 = getelementptr inbounds [17 x float], ptr %9, i64 0, i64 %123
  %126 = load float, ptr %125, align 4
  %127 = fcmp contract ogt float %126, %124
  %128 = select i1 %127, float %126, float %124
  %129 = add nuw i64 %123, 1
  %130 = icmp eq i64 %123, %12
  br i1 %130, label %118, label %122

131:
  %132 = phi i64 [ 0, %120 ], [ %138, %131 ]
  %133 = phi float [ %119, %120 ], [ %137, %131 ]
  %134 = getelementptr inbounds [136 x float], ptr %121, i64 0, i64 %132
  %135 = load float, ptr %134, align 4
  %136 = fcmp contract ogt float %135, %133
  %137 = select i1 %136, float %135, float %133
  %138 = add nuw nsw i64 %132, 1
  %139 = icmp eq i64 %138, %21
  br i1 %139, label %140, label %131

140:
  %141 = phi float [ %119, %118 ], [ %137, %131 ]
  %142 = fmul contract float %3, 1.600000e+01
  %143 = fdiv contract float %141, %142
  %144 = fptosi float %143 to i64
  %145 = add i64 %144, 1
  %146 = shl nsw i64 %145, 4
  %147 = sitofp i64 %146 to float
  br label %195

148:
  %149 = phi i64 [ %151, %148 ], [ 680, %112 ]
  %150 = getelementptr inbounds i8, ptr %9, i64 %149
  store float %4, ptr %150, align 4
  %151 = add nuw nsw i64 %149, 4
  %152 = icmp eq i64 %151, 1224
  br i1 %152, label %117, label %148

153:
  call void @llvm.lifetime.start.p0(i64 13056, ptr nonnull %11)
  %154 = icmp slt i64 %144, 0
  br i1 %154, label %1276, label %155

155:
  %156 = fdiv contract float 1.000000e+00, %147
  %157 = insertelement <16 x float> poison, float %156, i64 0
  %158 = shufflevector <16 x float> %157, <16 x float> poison, <16 x i32> zeroinitializer
  %159 = getelementptr inbounds i8, ptr %11, i64 576
  %160 = icmp sgt i64 %12, 0
  %161 = getelementptr inbounds i8, ptr %0, i64 24
  %162 = load ptr, ptr %161, align 8
  %163 = fmul contract <16 x float> %201, zeroinitializer
  %164 = fmul contract <16 x float> %163, zeroinitializer
  %165 = icmp slt i64 %12, 1
  %166 = getelementptr inbounds i8, ptr %0, i64 48
  %167 = load ptr, ptr %166, align 8
  %168 = getelementptr inbounds i8, ptr %9, i64 68
  %169 = getelementptr inbounds i8, ptr %0, i64 8
  %170 = load i64, ptr %169, align 8
  %171 = icmp sgt i64 %170, 0
  %172 = getelementptr inbounds i8, ptr %0, i64 56
  %173 = load ptr, ptr %172, align 8
  %174 = getelementptr inbounds i8, ptr %0, i64 64
  %175 = load ptr, ptr %174, align 8
  %176 = getelementptr inbounds i8, ptr %0, i64 32
  %177 = load ptr, ptr %176, align 8
  %178 = getelementptr inbounds i8, ptr %0, i64 40
  %179 = load ptr, ptr %178, align 8
  %180 = getelementptr inbounds i8, ptr %0, i64 96
  %181 = load ptr, ptr %180, align 8
  %182 = getelementptr inbounds i8, ptr %0, i64 88
  %183 = load ptr, ptr %182, align 8
  %184 = getelementptr inbounds i8, ptr %9, i64 136
  %185 = getelementptr inbounds i8, ptr %9, i64 680
  %186 = getelementptr inbounds i8, ptr %0, i64 128
  %187 = load ptr, ptr %186, align 8
  %188 = getelementptr inbounds i8, ptr %7, i64 8
  %189 = getelementptr inbounds i8, ptr %0, i64 80
  %190 = load ptr, ptr %189, align 8
  %191 = getelementptr inbounds i8, ptr %0, i64 72
  %192 = load ptr, ptr %191, align 8
  %193 = getelementptr inbounds i8, ptr %0, i64 104
  %194 = load ptr, ptr %193, align 8
  br label %208

195:
  %196 = phi i64 [ 0, %140 ], [ %202, %195 ]
  %197 = phi <16 x float> [ undef, %140 ], [ %201, %195 ]
  %198 = mul nsw i64 %196, %145
  %199 = add nsw i64 %198, 1
  %200 = sitofp i64 %199 to float
  %201 = insertelement <16 x float> %197, float %200, i64 %196
  %202 = add nuw nsw i64 %196, 1
  %203 = icmp eq i64 %202, 16
  br i1 %203, label %153, label %195

204:
  %205 = add nuw i64 %210, 1
  %206 = icmp sge i64 %210, %144
  %207 = icmp eq i64 %210, %144
  br i1 %207, label %1276, label %208

208:
  %209 = phi i1 [ false, %155 ], [ %206, %204 ]
  %210 = phi i64 [ 0, %155 ], [ %205, %204 ]
  %211 = uitofp nneg i64 %210 to float
  %212 = insertelement <16 x float> poison, float %211, i64 0
  %213 = shufflevector <16 x float> %212, <16 x float> poison, <16 x i32> zeroinitializer
  %214 = fadd contract <16 x float> %201, %213
  %215 = fmul contract <16 x float> %158, %214
  %216 = fmul contract <16 x float> %215, zeroinitializer
  br label %217

217:
  %218 = phi i64 [ 0, %208 ], [ %226, %217 ]
  %219 = and i64 %218, 3
  %220 = icmp eq i64 %219, 0
  %221 = uitofp i1 %220 to float
  %222 = insertelement <16 x float> poison, float %221, i64 0
  %223 = shufflevector <16 x float> %222, <16 x float> poison, <16 x i32> zeroinitializer
  %224 = fadd contract <16 x float> %216, %223
  %225 = getelementptr inbounds [9 x <16 x float>], ptr %11, i64 0, i64 %218
  store <16 x float> %224, ptr %225, align 64
  %226 = add nuw nsw i64 %218, 1
  %227 = icmp eq i64 %226, 9
  br i1 %227, label %229, label %217

228:
  br i1 %160, label %234, label %763

229:
  %230 = phi i64 [ %232, %229 ], [ 0, %217 ]
  %231 = getelementptr inbounds [3 x <16 x float>], ptr %159, i64 0, i64 %230
  store <16 x float> %216, ptr %231, align 64
  %232 = add nuw nsw i64 %230, 1
  %233 = icmp eq i64 %232, 3
  br i1 %233, label %228, label %229

234:
  %235 = phi i64 [ %238, %430 ], [ 0, %228 ]
  %236 = getelementptr inbounds %struct.Joint, ptr %162, i64 %235
  %237 = getelementptr inbounds %struct.Frame, ptr %11, i64 %235
  %238 = add nuw nsw i64 %235, 1
  %239 = getelementptr inbounds float, ptr %1, i64 %235
  %240 = load float, ptr %239, align 4
  %241 = insertelement <16 x float> poison, float %240, i64 0
  %242 = getelementptr inbounds float, ptr %2, i64 %235
  %243 = load float, ptr %242, align 4
  %244 = insertelement <16 x float> poison, float %243, i64 0
  %245 = shufflevector <16 x float> %244, <16 x float> poison, <16 x i32> zeroinitializer
  %246 = fmul contract <16 x float> %215, %245
  %247 = getelementptr inbounds i8, ptr %236, i64 36
  %248 = load float, ptr %247, align 4
  %249 = getelementptr inbounds i8, ptr %236, i64 40
  %250 = load float, ptr %249, align 4
  %251 = getelementptr inbounds i8, ptr %236, i64 44
  %252 = load float, ptr %251, align 4
  %253 = getelementptr inbounds i8, ptr %237, i64 576
  %254 = load <16 x float>, ptr %253, align 64
  %255 = load <16 x float>, ptr %237, align 64
  %256 = insertelement <16 x float> poison, float %248, i64 0
  %257 = shufflevector <16 x float> %256, <16 x float> poison, <16 x i32> zeroinitializer
  %258 = fmul contract <16 x float> %257, %255
  %259 = getelementptr inbounds i8, ptr %237, i64 64
  %260 = load <16 x float>, ptr %259, align 64
  %261 = insertelement <16 x float> poison, float %250, i64 0
  %262 = shufflevector <16 x float> %261, <16 x float> poison, <16 x i32> zeroinitializer
  %263 = fmul contract <16 x float> %262, %260
  %264 = getelementptr inbounds i8, ptr %237, i64 128
  %265 = load <16 x float>, ptr %264, align 64
  %266 = insertelement <16 x float> poison, float %252, i64 0
  %267 = shufflevector <16 x float> %266, <16 x float> poison, <16 x i32> zeroinitializer
  %268 = fmul contract <16 x float> %267, %265
  %269 = getelementptr inbounds i8, ptr %237, i64 640
  %270 = load <16 x float>, ptr %269, align 64
  %271 = getelementptr inbounds i8, ptr %237, i64 192
  %272 = load <16 x float>, ptr %271, align 64
  %273 = fmul contract <16 x float> %257, %272
  %274 = getelementptr inbounds i8, ptr %237, i64 256
  %275 = load <16 x float>, ptr %274, align 64
  %276 = fmul contract <16 x float> %262, %275
  %277 = getelementptr inbounds i8, ptr %237, i64 320
  %278 = load <16 x float>, ptr %277, align 64
  %279 = fmul contract <16 x float> %267, %278
  %280 = getelementptr inbounds i8, ptr %237, i64 704
  %281 = load <16 x float>, ptr %280, align 64
  %282 = getelementptr inbounds i8, ptr %237, i64 384
  %283 = load <16 x float>, ptr %282, align 64
  %284 = fmul contract <16 x float> %257, %283
  %285 = getelementptr inbounds i8, ptr %237, i64 448
  %286 = load <16 x float>, ptr %285, align 64
  %287 = fmul contract <16 x float> %262, %286
  %288 = getelementptr inbounds i8, ptr %237, i64 512
  %289 = load <16 x float>, ptr %288, align 64
  %290 = fmul contract <16 x float> %267, %289
  call void @llvm.lifetime.start.p0(i64 576, ptr nonnull %8)
  br label %291

291:
  %292 = phi i64 [ 0, %234 ], [ %322, %321 ]
  %293 = mul nuw nsw i64 %292, 3
  %294 = getelementptr inbounds [9 x <16 x float>], ptr %237, i64 0, i64 %293
  %295 = load <16 x float>, ptr %294, align 64
  %296 = add nuw nsw i64 %293, 1
  %297 = getelementptr inbounds [9 x <16 x float>], ptr %237, i64 0, i64 %296
  %298 = load <16 x float>, ptr %297, align 64
  %299 = add nuw nsw i64 %293, 2
  %300 = getelementptr inbounds [9 x <16 x float>], ptr %237, i64 0, i64 %299
  %301 = load <16 x float>, ptr %300, align 64
  br label %324

302:
  %303 = getelementptr inbounds %struct.Frame, ptr %11, i64 %238
  %304 = shufflevector <16 x float> %241, <16 x float> poison, <16 x i32> zeroinitializer
  %305 = fadd contract <16 x float> %304, %246
  %306 = fadd contract <16 x float> %254, %258
  %307 = fadd contract <16 x float> %306, %263
  %308 = fadd contract <16 x float> %307, %268
  %309 = fadd contract <16 x float> %270, %273
  %310 = fadd contract <16 x float> %309, %276
  %311 = fadd contract <16 x float> %310, %279
  %312 = fadd contract <16 x float> %281, %284
  %313 = fadd contract <16 x float> %312, %287
  %314 = fadd contract <16 x float> %313, %290
  %315 = getelementptr inbounds i8, ptr %303, i64 576
  store <16 x float> %308, ptr %315, align 64
  %316 = getelementptr inbounds i8, ptr %303, i64 640
  store <16 x float> %311, ptr %316, align 64
  %317 = getelementptr inbounds i8, ptr %303, i64 704
  store <16 x float> %314, ptr %317, align 64
  %318 = getelementptr inbounds i8, ptr %236, i64 48
  %319 = load float, ptr %318, align 4
  %320 = fcmp contract une float %319, 0.000000e+00
  br i1 %320, label %349, label %368

321:
  %322 = add nuw nsw i64 %292, 1
  %323 = icmp eq i64 %322, 3
  br i1 %323, label %302, label %291

324:
  %325 = phi i64 [ 0, %291 ], [ %347, %324 ]
  %326 = getelementptr inbounds [9 x float], ptr %236, i64 0, i64 %325
  %327 = load float, ptr %326, align 4
  %328 = insertelement <16 x float> poison, float %327, i64 0
  %329 = shufflevector <16 x float> %328, <16 x float> poison, <16 x i32> zeroinitializer
  %330 = fmul contract <16 x float> %295, %329
  %331 = add nuw nsw i64 %325, 3
  %332 = getelementptr inbounds [9 x float], ptr %236, i64 0, i64 %331
  %333 = load float, ptr %332, align 4
  %334 = insertelement <16 x float> poison, float %333, i64 0
  %335 = shufflevector <16 x float> %334, <16 x float> poison, <16 x i32> zeroinitializer
  %336 = fmul contract <16 x float> %298, %335
  %337 = fadd contract <16 x float> %330, %336
  %338 = add nuw nsw i64 %325, 6
  %339 = getelementptr inbounds [9 x float], ptr %236, i64 0, i64 %338
  %340 = load float, ptr %339, align 4
  %341 = insertelement <16 x float> poison, float %340, i64 0
  %342 = shufflevector <16 x float> %341, <16 x float> poison, <16 x i32> zeroinitializer
  %343 = fmul contract <16 x float> %301, %342
  %344 = fadd contract <16 x float> %337, %343
  %345 = add nuw nsw i64 %325, %293
  %346 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %345
  store <16 x float> %344, ptr %346, align 64
  %347 = add nuw nsw i64 %325, 1
  %348 = icmp eq i64 %347, 3
  br i1 %348, label %321, label %324

349:
  %350 = phi i64 [ %354, %349 ], [ 0, %302 ]
  %351 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %350
  %352 = load <16 x float>, ptr %351, align 64
  %353 = getelementptr inbounds [9 x <16 x float>], ptr %303, i64 0, i64 %350
  store <16 x float> %352, ptr %353, align 64
  %354 = add nuw nsw i64 %350, 1
  %355 = icmp eq i64 %354, 9
  br i1 %355, label %356, label %349

356:
  %357 = phi i64 [ %366, %356 ], [ 0, %349 ]
  %358 = mul nuw nsw i64 %357, 3
  %359 = add nuw nsw i64 %358, 2
  %360 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %359
  %361 = load <16 x float>, ptr %360, align 64
  %362 = fmul contract <16 x float> %305, %361
  %363 = getelementptr inbounds [3 x <16 x float>], ptr %315, i64 0, i64 %357
  %364 = load <16 x float>, ptr %363, align 64
  %365 = fadd contract <16 x float> %364, %362
  store <16 x float> %365, ptr %363, align 64
  %366 = add nuw nsw i64 %357, 1
  %367 = icmp eq i64 %366, 3
  br i1 %367, label %430, label %356

368:
  %369 = fmul contract <16 x float> %305, <float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000, float 0x3FD45F3060000000>
  %370 = fadd contract <16 x float> %369, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %371 = fadd contract <16 x float> %370, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %372 = fmul contract <16 x float> %371, <float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000, float 0x4009200000000000>
  %373 = fsub contract <16 x float> %305, %372
  %374 = fmul contract <16 x float> %371, <float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000, float 0x3F4FB40000000000>
  %375 = fsub contract <16 x float> %373, %374
  %376 = fmul contract <16 x float> %371, <float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000, float 0x3E84442D20000000>
  %377 = fsub contract <16 x float> %375, %376
  %378 = fmul contract <16 x float> %371, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %379 = fadd contract <16 x float> %378, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %380 = fadd contract <16 x float> %379, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %381 = fsub contract <16 x float> %378, %380
  %382 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %381)
  %383 = fmul contract <16 x float> %382, <float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00, float 4.000000e+00>
  %384 = fsub contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %383
  %385 = fmul contract <16 x float> %377, %377
  %386 = fmul contract <16 x float> %377, %385
  %387 = fmul contract <16 x float> %385, <float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000, float 0x3EC5CF7520000000>
  %388 = fadd contract <16 x float> %387, <float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000, float 0xBF29943F20000000>
  %389 = fmul contract <16 x float> %385, %388
  %390 = fadd contract <16 x float> %389, <float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000, float 0x3F811073C0000000>
  %391 = fmul contract <16 x float> %385, %390
  %392 = fadd contract <16 x float> %391, <float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000, float 0xBFC5555460000000>
  %393 = fmul contract <16 x float> %386, %392
  %394 = fadd contract <16 x float> %377, %393
  %395 = fmul contract <16 x float> %384, %394
  %396 = fmul contract <16 x float> %385, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %397 = fsub contract <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, %396
  %398 = fmul contract <16 x float> %385, %385
  %399 = fmul contract <16 x float> %385, <float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000, float 0x3E9172C420000000>
  %400 = fsub contract <16 x float> <float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000, float 0x3EF99EB9C0000000>, %399
  %401 = fmul contract <16 x float> %385, %400
  %402 = fadd contract <16 x float> %401, <float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000, float 0xBF56C0C340000000>
  %403 = fmul contract <16 x float> %385, %402
  %404 = fadd contract <16 x float> %403, <float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000, float 0x3FA55554A0000000>
  %405 = fmul contract <16 x float> %398, %404
  %406 = fadd contract <16 x float> %397, %405
  %407 = fmul contract <16 x float> %384, %406
  br label %408

408:
  %409 = phi i64 [ 0, %368 ], [ %428, %408 ]
  %410 = mul nuw nsw i64 %409, 3
  %411 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %410
  %412 = load <16 x float>, ptr %411, align 64
  %413 = fmul contract <16 x float> %407, %412
  %414 = add nuw nsw i64 %410, 1
  %415 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %414
  %416 = load <16 x float>, ptr %415, align 64
  %417 = fmul contract <16 x float> %395, %416
  %418 = fadd contract <16 x float> %413, %417
  %419 = getelementptr inbounds [9 x <16 x float>], ptr %303, i64 0, i64 %410
  store <16 x float> %418, ptr %419, align 64
  %420 = fmul contract <16 x float> %407, %416
  %421 = fmul contract <16 x float> %395, %412
  %422 = fsub contract <16 x float> %420, %421
  %423 = getelementptr inbounds [9 x <16 x float>], ptr %303, i64 0, i64 %414
  store <16 x float> %422, ptr %423, align 64
  %424 = add nuw nsw i64 %410, 2
  %425 = getelementptr inbounds [9 x <16 x float>], ptr %8, i64 0, i64 %424
  %426 = load <16 x float>, ptr %425, align 64
  %427 = getelementptr inbounds [9 x <16 x float>], ptr %303, i64 0, i64 %424
  store <16 x float> %426, ptr %427, align 64
  %428 = add nuw nsw i64 %409, 1
  %429 = icmp eq i64 %428, 3
  br i1 %429, label %430, label %408

430:
  call void @llvm.lifetime.end.p0(i64 576, ptr nonnull %8)
  %431 = icmp eq i64 %238, %12
  br i1 %431, label %432, label %234

432:
  br i1 %165, label %763, label %433

433:
  %434 = phi <16 x i32> [ %760, %759 ], [ zeroinitializer, %432 ]
  %435 = phi i64 [ %761, %759 ], [ 1, %432 ]
  %436 = getelementptr inbounds %struct.Sphere, ptr %167, i64 %435
  %437 = getelementptr inbounds i8, ptr %436, i64 12
  %438 = load float, ptr %437, align 4
  %439 = fcmp contract olt float %438, 0.000000e+00
  br i1 %439, label %759, label %440

440:
  %441 = getelementptr inbounds %struct.Frame, ptr %11, i64 %435
  %442 = load float, ptr %436, align 4
  %443 = getelementptr inbounds i8, ptr %436, i64 4
  %444 = load float, ptr %443, align 4
  %445 = getelementptr inbounds i8, ptr %436, i64 8
  %446 = load float, ptr %445, align 4
  %447 = getelementptr inbounds i8, ptr %441, i64 576
  %448 = load <16 x float>, ptr %447, align 64
  %449 = load <16 x float>, ptr %441, align 64
  %450 = insertelement <16 x float> poison, float %442, i64 0
  %451 = shufflevector <16 x float> %450, <16 x float> poison, <16 x i32> zeroinitializer
  %452 = fmul contract <16 x float> %451, %449
  %453 = fadd contract <16 x float> %448, %452
  %454 = getelementptr inbounds i8, ptr %441, i64 64
  %455 = load <16 x float>, ptr %454, align 64
  %456 = insertelement <16 x float> poison, float %444, i64 0
  %457 = shufflevector <16 x float> %456, <16 x float> poison, <16 x i32> zeroinitializer
  %458 = fmul contract <16 x float> %457, %455
  %459 = fadd contract <16 x float> %453, %458
  %460 = getelementptr inbounds i8, ptr %441, i64 128
  %461 = load <16 x float>, ptr %460, align 64
  %462 = insertelement <16 x float> poison, float %446, i64 0
  %463 = shufflevector <16 x float> %462, <16 x float> poison, <16 x i32> zeroinitializer
  %464 = fmul contract <16 x float> %463, %461
  %465 = fadd contract <16 x float> %459, %464
  %466 = getelementptr inbounds i8, ptr %441, i64 640
  %467 = load <16 x float>, ptr %466, align 64
  %468 = getelementptr inbounds i8, ptr %441, i64 192
  %469 = load <16 x float>, ptr %468, align 64
  %470 = fmul contract <16 x float> %451, %469
  %471 = fadd contract <16 x float> %467, %470
  %472 = getelementptr inbounds i8, ptr %441, i64 256
  %473 = load <16 x float>, ptr %472, align 64
  %474 = fmul contract <16 x float> %457, %473
  %475 = fadd contract <16 x float> %471, %474
  %476 = getelementptr inbounds i8, ptr %441, i64 320
  %477 = load <16 x float>, ptr %476, align 64
  %478 = fmul contract <16 x float> %463, %477
  %479 = fadd contract <16 x float> %475, %478
  %480 = getelementptr inbounds i8, ptr %441, i64 704
  %481 = load <16 x float>, ptr %480, align 64
  %482 = getelementptr inbounds i8, ptr %441, i64 384
  %483 = load <16 x float>, ptr %482, align 64
  %484 = fmul contract <16 x float> %451, %483
  %485 = fadd contract <16 x float> %481, %484
  %486 = getelementptr inbounds i8, ptr %441, i64 448
  %487 = load <16 x float>, ptr %486, align 64
  %488 = fmul contract <16 x float> %457, %487
  %489 = fadd contract <16 x float> %485, %488
  %490 = getelementptr inbounds i8, ptr %441, i64 512
  %491 = load <16 x float>, ptr %490, align 64
  %492 = fmul contract <16 x float> %463, %491
  %493 = fadd contract <16 x float> %489, %492
  %494 = getelementptr inbounds [17 x float], ptr %9, i64 0, i64 %435
  %495 = load float, ptr %494, align 4
  %496 = insertelement <16 x float> poison, float %495, i64 0
  %497 = shufflevector <16 x float> %496, <16 x float> poison, <16 x i32> zeroinitializer
  %498 = fmul contract <16 x float> %163, %497
  %499 = getelementptr inbounds [17 x float], ptr %168, i64 0, i64 %435
  %500 = load float, ptr %499, align 4
  %501 = insertelement <16 x float> poison, float %500, i64 0
  %502 = shufflevector <16 x float> %501, <16 x float> poison, <16 x i32> zeroinitializer
  %503 = fadd contract <16 x float> %498, %502
  br i1 %171, label %504, label %759

504:
  %505 = mul nuw nsw i64 %170, %435
  %506 = getelementptr float, ptr %175, i64 %505
  %507 = getelementptr inbounds i64, ptr %177, i64 %435
  %508 = getelementptr inbounds i8, ptr %507, i64 8
  br label %509

509:
  %510 = phi <16 x i32> [ %434, %504 ], [ %756, %755 ]
  %511 = phi i64 [ 0, %504 ], [ %757, %755 ]
  %512 = getelementptr inbounds %struct.Object, ptr %173, i64 %511
  %513 = getelementptr float, ptr %506, i64 %511
  %514 = load float, ptr %513, align 4
  %515 = getelementptr inbounds i8, ptr %512, i64 60
  %516 = load float, ptr %515, align 4
  %517 = fadd contract float %514, %516
  %518 = fcmp contract olt float %517, -1.000000e+08
  br i1 %518, label %755, label %519

519:
  %520 = fadd contract float %438, %517
  %521 = insertelement <16 x float> poison, float %520, i64 0
  %522 = shufflevector <16 x float> %521, <16 x float> poison, <16 x i32> zeroinitializer
  %523 = fadd contract <16 x float> %503, %522
  %524 = fcmp contract ogt <16 x float> %523, %164
  %525 = select contract <16 x i1> %524, <16 x float> %523, <16 x float> %164
  %526 = getelementptr inbounds i8, ptr %512, i64 36
  %527 = load float, ptr %526, align 4
  %528 = insertelement <16 x float> poison, float %527, i64 0
  %529 = shufflevector <16 x float> %528, <16 x float> poison, <16 x i32> zeroinitializer
  %530 = load float, ptr %512, align 4
  %531 = insertelement <16 x float> poison, float %530, i64 0
  %532 = shufflevector <16 x float> %531, <16 x float> poison, <16 x i32> zeroinitializer
  %533 = fmul contract <16 x float> %465, %532
  %534 = fadd contract <16 x float> %529, %533
  %535 = getelementptr inbounds i8, ptr %512, i64 4
  %536 = load float, ptr %535, align 4
  %537 = insertelement <16 x float> poison, float %536, i64 0
  %538 = shufflevector <16 x float> %537, <16 x float> poison, <16 x i32> zeroinitializer
  %539 = fmul contract <16 x float> %479, %538
  %540 = fadd contract <16 x float> %534, %539
  %541 = getelementptr inbounds i8, ptr %512, i64 8
  %542 = load float, ptr %541, align 4
  %543 = insertelement <16 x float> poison, float %542, i64 0
  %544 = shufflevector <16 x float> %543, <16 x float> poison, <16 x i32> zeroinitializer
  %545 = fmul contract <16 x float> %493, %544
  %546 = fadd contract <16 x float> %540, %545
  %547 = getelementptr inbounds i8, ptr %512, i64 40
  %548 = load float, ptr %547, align 4
  %549 = insertelement <16 x float> poison, float %548, i64 0
  %550 = shufflevector <16 x float> %549, <16 x float> poison, <16 x i32> zeroinitializer
  %551 = getelementptr inbounds i8, ptr %512, i64 12
  %552 = load float, ptr %551, align 4
  %553 = insertelement <16 x float> poison, float %552, i64 0
  %554 = shufflevector <16 x float> %553, <16 x float> poison, <16 x i32> zeroinitializer
  %555 = fmul contract <16 x float> %465, %554
  %556 = fadd contract <16 x float> %550, %555
  %557 = getelementptr inbounds i8, ptr %512, i64 16
  %558 = load float, ptr %557, align 4
  %559 = insertelement <16 x float> poison, float %558, i64 0
  %560 = shufflevector <16 x float> %559, <16 x float> poison, <16 x i32> zeroinitializer
  %561 = fmul contract <16 x float> %479, %560
  %562 = fadd contract <16 x float> %556, %561
  %563 = getelementptr inbounds i8, ptr %512, i64 20
  %564 = load float, ptr %563, align 4
  %565 = insertelement <16 x float> poison, float %564, i64 0
  %566 = shufflevector <16 x float> %565, <16 x float> poison, <16 x i32> zeroinitializer
  %567 = fmul contract <16 x float> %493, %566
  %568 = fadd contract <16 x float> %562, %567
  %569 = getelementptr inbounds i8, ptr %512, i64 44
  %570 = load float, ptr %569, align 4
  %571 = insertelement <16 x float> poison, float %570, i64 0
  %572 = shufflevector <16 x float> %571, <16 x float> poison, <16 x i32> zeroinitializer
  %573 = getelementptr inbounds i8, ptr %512, i64 24
  %574 = load float, ptr %573, align 4
  %575 = insertelement <16 x float> poison, float %574, i64 0
  %576 = shufflevector <16 x float> %575, <16 x float> poison, <16 x i32> zeroinitializer
  %577 = fmul contract <16 x float> %465, %576
  %578 = fadd contract <16 x float> %572, %577
  %579 = getelementptr inbounds i8, ptr %512, i64 28
  %580 = load float, ptr %579, align 4
  %581 = insertelement <16 x float> poison, float %580, i64 0
  %582 = shufflevector <16 x float> %581, <16 x float> poison, <16 x i32> zeroinitializer
  %583 = fmul contract <16 x float> %479, %582
  %584 = fadd contract <16 x float> %578, %583
  %585 = getelementptr inbounds i8, ptr %512, i64 32
  %586 = load float, ptr %585, align 4
  %587 = insertelement <16 x float> poison, float %586, i64 0
  %588 = shufflevector <16 x float> %587, <16 x float> poison, <16 x i32> zeroinitializer
  %589 = fmul contract <16 x float> %493, %588
  %590 = fadd contract <16 x float> %584, %589
  %591 = fmul contract <16 x float> %546, zeroinitializer
  %592 = getelementptr inbounds i8, ptr %512, i64 68
  %593 = load float, ptr %592, align 4
  %594 = fcmp contract une float %593, 0.000000e+00
  %595 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %590)
  %596 = select contract i1 %594, <16 x float> %590, <16 x float> %595
  %597 = getelementptr inbounds i8, ptr %512, i64 64
  %598 = load float, ptr %597, align 4
  %599 = fcmp contract une float %598, 0.000000e+00
  br i1 %599, label %600, label %605

600:
  %601 = fmul contract <16 x float> %546, %546
  %602 = fmul contract <16 x float> %568, %568
  %603 = fadd contract <16 x float> %601, %602
  %604 = tail call contract noundef <16 x float> @llvm.sqrt.v16f32(<16 x float> %603)
  br label %607

605:
  %606 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %546)
  br label %607

607:
  %608 = phi contract <16 x float> [ %604, %600 ], [ %606, %605 ]
  %609 = getelementptr inbounds i8, ptr %512, i64 48
  %610 = load float, ptr %609, align 4
  %611 = insertelement <16 x float> poison, float %610, i64 0
  %612 = shufflevector <16 x float> %611, <16 x float> poison, <16 x i32> zeroinitializer
  %613 = fsub contract <16 x float> %608, %612
  %614 = fcmp contract ogt <16 x float> %613, %591
  %615 = select contract <16 x i1> %614, <16 x float> %613, <16 x float> %591
  %616 = getelementptr inbounds i8, ptr %512, i64 56
  %617 = load float, ptr %616, align 4
  %618 = insertelement <16 x float> poison, float %617, i64 0
  %619 = shufflevector <16 x float> %618, <16 x float> poison, <16 x i32> zeroinitializer
  %620 = fsub contract <16 x float> %596, %619
  %621 = fcmp contract ogt <16 x float> %620, %591
  %622 = select contract <16 x i1> %621, <16 x float> %620, <16 x float> %591
  %623 = fmul contract <16 x float> %615, %615
  %624 = fmul contract <16 x float> %622, %622
  %625 = fadd contract <16 x float> %623, %624
  br i1 %599, label %637, label %626

626:
  %627 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %568)
  %628 = getelementptr inbounds i8, ptr %512, i64 52
  %629 = load float, ptr %628, align 4
  %630 = insertelement <16 x float> poison, float %629, i64 0
  %631 = shufflevector <16 x float> %630, <16 x float> poison, <16 x i32> zeroinitializer
  %632 = fsub contract <16 x float> %627, %631
  %633 = fcmp contract ogt <16 x float> %632, %591
  %634 = select contract <16 x i1> %633, <16 x float> %632, <16 x float> %591
  %635 = fmul contract <16 x float> %634, %634
  %636 = fadd contract <16 x float> %625, %635
  br label %637

637:
  %638 = phi <16 x float> [ %636, %626 ], [ %625, %607 ]
  %639 = fmul contract <16 x float> %525, %525
  %640 = fcmp contract olt <16 x float> %638, %639
  %641 = bitcast <16 x i1> %640 to i16
  %642 = icmp eq i16 %641, 0
  br i1 %642, label %755, label %643

643:
  %644 = load i64, ptr %507, align 8
  %645 = load i64, ptr %508, align 8
  %646 = icmp slt i64 %644, %645
  br i1 %646, label %647, label %750

647:
  %648 = getelementptr inbounds i8, ptr %512, i64 52
  br label %652

649:
  %650 = add i64 %654, 1
  %651 = icmp eq i64 %650, %645
  br i1 %651, label %750, label %652

652:
  %653 = phi <16 x i32> [ %510, %647 ], [ %746, %649 ]
  %654 = phi i64 [ %644, %647 ], [ %650, %649 ]
  %655 = getelementptr inbounds %struct.Sphere, ptr %179, i64 %654
  %656 = getelementptr inbounds i8, ptr %655, i64 12
  %657 = load float, ptr %656, align 4
  %658 = fadd contract float %517, %657
  %659 = insertelement <16 x float> poison, float %658, i64 0
  %660 = shufflevector <16 x float> %659, <16 x float> poison, <16 x i32> zeroinitializer
  %661 = fadd contract <16 x float> %503, %660
  %662 = fcmp contract ogt <16 x float> %661, %164
  %663 = select contract <16 x i1> %662, <16 x float> %661, <16 x float> %164
  %664 = load float, ptr %655, align 4
  %665 = getelementptr inbounds i8, ptr %655, i64 4
  %666 = load float, ptr %665, align 4
  %667 = getelementptr inbounds i8, ptr %655, i64 8
  %668 = load float, ptr %667, align 4
  %669 = insertelement <16 x float> poison, float %664, i64 0
  %670 = shufflevector <16 x float> %669, <16 x float> poison, <16 x i32> zeroinitializer
  %671 = fmul contract <16 x float> %449, %670
  %672 = fadd contract <16 x float> %448, %671
  %673 = insertelement <16 x float> poison, float %666, i64 0
  %674 = shufflevector <16 x float> %673, <16 x float> poison, <16 x i32> zeroinitializer
  %675 = fmul contract <16 x float> %455, %674
  %676 = fadd contract <16 x float> %672, %675
  %677 = insertelement <16 x float> poison, float %668, i64 0
  %678 = shufflevector <16 x float> %677, <16 x float> poison, <16 x i32> zeroinitializer
  %679 = fmul contract <16 x float> %461, %678
  %680 = fadd contract <16 x float> %676, %679
  %681 = fmul contract <16 x float> %469, %670
  %682 = fadd contract <16 x float> %467, %681
  %683 = fmul contract <16 x float> %473, %674
  %684 = fadd contract <16 x float> %682, %683
  %685 = fmul contract <16 x float> %477, %678
  %686 = fadd contract <16 x float> %684, %685
  %687 = fmul contract <16 x float> %483, %670
  %688 = fadd contract <16 x float> %481, %687
  %689 = fmul contract <16 x float> %487, %674
  %690 = fadd contract <16 x float> %688, %689
  %691 = fmul contract <16 x float> %491, %678
  %692 = fadd contract <16 x float> %690, %691
  %693 = fmul contract <16 x float> %532, %680
  %694 = fadd contract <16 x float> %529, %693
  %695 = fmul contract <16 x float> %538, %686
  %696 = fadd contract <16 x float> %695, %694
  %697 = fmul contract <16 x float> %544, %692
  %698 = fadd contract <16 x float> %697, %696
  %699 = fmul contract <16 x float> %554, %680
  %700 = fadd contract <16 x float> %550, %699
  %701 = fmul contract <16 x float> %560, %686
  %702 = fadd contract <16 x float> %701, %700
  %703 = fmul contract <16 x float> %566, %692
  %704 = fadd contract <16 x float> %703, %702
  %705 = fmul contract <16 x float> %576, %680
  %706 = fadd contract <16 x float> %572, %705
  %707 = fmul contract <16 x float> %582, %686
  %708 = fadd contract <16 x float> %707, %706
  %709 = fmul contract <16 x float> %588, %692
  %710 = fadd contract <16 x float> %709, %708
  %711 = fmul contract <16 x float> %698, zeroinitializer
  %712 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %710)
  %713 = select contract i1 %594, <16 x float> %710, <16 x float> %712
  br i1 %599, label %714, label %719

714:
  %715 = fmul contract <16 x float> %698, %698
  %716 = fmul contract <16 x float> %704, %704
  %717 = fadd contract <16 x float> %715, %716
  %718 = tail call contract noundef <16 x float> @llvm.sqrt.v16f32(<16 x float> %717)
  br label %721

719:
  %720 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %698)
  br label %721

721:
  %722 = phi contract <16 x float> [ %718, %714 ], [ %720, %719 ]
  %723 = fsub contract <16 x float> %722, %612
  %724 = fcmp contract ogt <16 x float> %723, %711
  %725 = select contract <16 x i1> %724, <16 x float> %723, <16 x float> %711
  %726 = fsub contract <16 x float> %713, %619
  %727 = fcmp contract ogt <16 x float> %726, %711
  %728 = select contract <16 x i1> %727, <16 x float> %726, <16 x float> %711
  %729 = fmul contract <16 x float> %725, %725
  %730 = fmul contract <16 x float> %728, %728
  %731 = fadd contract <16 x float> %730, %729
  br i1 %599, label %742, label %732

732:
  %733 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %704)
  %734 = load float, ptr %648, align 4
  %735 = insertelement <16 x float> poison, float %734, i64 0
  %736 = shufflevector <16 x float> %735, <16 x float> poison, <16 x i32> zeroinitializer
  %737 = fsub contract <16 x float> %733, %736
  %738 = fcmp contract ogt <16 x float> %737, %711
  %739 = select contract <16 x i1> %738, <16 x float> %737, <16 x float> %711
  %740 = fmul contract <16 x float> %739, %739
  %741 = fadd contract <16 x float> %731, %740
  br label %742

742:
  %743 = phi <16 x float> [ %741, %732 ], [ %731, %721 ]
  %744 = fmul contract <16 x float> %663, %663
  %745 = fcmp contract olt <16 x float> %743, %744
  %746 = select <16 x i1> %745, <16 x i32> <i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1>, <16 x i32> %653
  %747 = icmp ne <16 x i32> %746, zeroinitializer
  %748 = bitcast <16 x i1> %747 to i16
  %749 = icmp eq i16 %748, 0
  br i1 %749, label %649, label %1271

750:
  %751 = phi <16 x i32> [ %510, %643 ], [ %746, %649 ]
  %752 = icmp eq <16 x i32> %751, zeroinitializer
  %753 = bitcast <16 x i1> %752 to i16
  %754 = icmp eq i16 %753, 0
  br i1 %754, label %1271, label %755

755:
  %756 = phi <16 x i32> [ %751, %750 ], [ %510, %637 ], [ %510, %509 ]
  %757 = add nuw nsw i64 %511, 1
  %758 = icmp eq i64 %757, %170
  br i1 %758, label %759, label %509

759:
  %760 = phi <16 x i32> [ %434, %433 ], [ %434, %440 ], [ %756, %755 ]
  %761 = add nuw i64 %435, 1
  %762 = icmp eq i64 %435, %12
  br i1 %762, label %763, label %433

763:
  %764 = phi <16 x i32> [ zeroinitializer, %432 ], [ zeroinitializer, %228 ], [ %760, %759 ]
  call void @llvm.lifetime.start.p0(i64 36864, ptr nonnull %6)
  br i1 %22, label %765, label %1269

765:
  %766 = phi <16 x i32> [ %1264, %1263 ], [ %764, %763 ]
  %767 = phi i64 [ %1265, %1263 ], [ 0, %763 ]
  %768 = phi i64 [ %1266, %1263 ], [ 0, %763 ]
  %769 = getelementptr inbounds %struct.LinkPair, ptr %181, i64 %768
  %770 = load i64, ptr %769, align 8
  %771 = getelementptr inbounds %struct.Sphere, ptr %183, i64 %770
  %772 = getelementptr inbounds i8, ptr %769, i64 8
  %773 = load i64, ptr %772, align 8
  %774 = getelementptr inbounds %struct.Sphere, ptr %183, i64 %773
  %775 = getelementptr inbounds %struct.Frame, ptr %11, i64 %770
  %776 = getelementptr inbounds %struct.Frame, ptr %11, i64 %773
  %777 = getelementptr inbounds [136 x float], ptr %184, i64 0, i64 %768
  %778 = load float, ptr %777, align 4
  %779 = insertelement <16 x float> poison, float %778, i64 0
  %780 = shufflevector <16 x float> %779, <16 x float> poison, <16 x i32> zeroinitializer
  %781 = fmul contract <16 x float> %163, %780
  %782 = getelementptr inbounds [136 x float], ptr %185, i64 0, i64 %768
  %783 = load float, ptr %782, align 4
  %784 = getelementptr inbounds float, ptr %187, i64 %768
  %785 = load float, ptr %784, align 4
  %786 = fadd contract float %783, %785
  %787 = insertelement <16 x float> poison, float %786, i64 0
  %788 = shufflevector <16 x float> %787, <16 x float> poison, <16 x i32> zeroinitializer
  %789 = fadd contract <16 x float> %781, %788
  %790 = load float, ptr %774, align 4
  %791 = getelementptr inbounds i8, ptr %774, i64 4
  %792 = load float, ptr %791, align 4
  %793 = getelementptr inbounds i8, ptr %774, i64 8
  %794 = load float, ptr %793, align 4
  %795 = getelementptr inbounds i8, ptr %776, i64 576
  %796 = load <16 x float>, ptr %795, align 64
  %797 = load <16 x float>, ptr %776, align 64
  %798 = insertelement <16 x float> poison, float %790, i64 0
  %799 = shufflevector <16 x float> %798, <16 x float> poison, <16 x i32> zeroinitializer
  %800 = fmul contract <16 x float> %799, %797
  %801 = fadd contract <16 x float> %796, %800
  %802 = getelementptr inbounds i8, ptr %776, i64 64
  %803 = load <16 x float>, ptr %802, align 64
  %804 = insertelement <16 x float> poison, float %792, i64 0
  %805 = shufflevector <16 x float> %804, <16 x float> poison, <16 x i32> zeroinitializer
  %806 = fmul contract <16 x float> %805, %803
  %807 = fadd contract <16 x float> %801, %806
  %808 = getelementptr inbounds i8, ptr %776, i64 128
  %809 = load <16 x float>, ptr %808, align 64
  %810 = insertelement <16 x float> poison, float %794, i64 0
  %811 = shufflevector <16 x float> %810, <16 x float> poison, <16 x i32> zeroinitializer
  %812 = fmul contract <16 x float> %811, %809
  %813 = fadd contract <16 x float> %807, %812
  %814 = getelementptr inbounds i8, ptr %776, i64 640
  %815 = load <16 x float>, ptr %814, align 64
  %816 = getelementptr inbounds i8, ptr %776, i64 192
  %817 = load <16 x float>, ptr %816, align 64
  %818 = fmul contract <16 x float> %799, %817
  %819 = fadd contract <16 x float> %815, %818
  %820 = getelementptr inbounds i8, ptr %776, i64 256
  %821 = load <16 x float>, ptr %820, align 64
  %822 = fmul contract <16 x float> %805, %821
  %823 = fadd contract <16 x float> %819, %822
  %824 = getelementptr inbounds i8, ptr %776, i64 320
  %825 = load <16 x float>, ptr %824, align 64
  %826 = fmul contract <16 x float> %811, %825
  %827 = fadd contract <16 x float> %823, %826
  %828 = getelementptr inbounds i8, ptr %776, i64 704
  %829 = load <16 x float>, ptr %828, align 64
  %830 = getelementptr inbounds i8, ptr %776, i64 384
  %831 = load <16 x float>, ptr %830, align 64
  %832 = fmul contract <16 x float> %799, %831
  %833 = fadd contract <16 x float> %829, %832
  %834 = getelementptr inbounds i8, ptr %776, i64 448
  %835 = load <16 x float>, ptr %834, align 64
  %836 = fmul contract <16 x float> %805, %835
  %837 = fadd contract <16 x float> %833, %836
  %838 = getelementptr inbounds i8, ptr %776, i64 512
  %839 = load <16 x float>, ptr %838, align 64
  %840 = fmul contract <16 x float> %811, %839
  %841 = fadd contract <16 x float> %837, %840
  %842 = getelementptr inbounds i8, ptr %771, i64 12
  %843 = load float, ptr %842, align 4
  %844 = getelementptr inbounds i8, ptr %774, i64 12
  %845 = load float, ptr %844, align 4
  %846 = fadd contract float %843, %845
  %847 = insertelement <16 x float> poison, float %846, i64 0
  %848 = shufflevector <16 x float> %847, <16 x float> poison, <16 x i32> zeroinitializer
  %849 = fadd contract <16 x float> %789, %848
  %850 = fcmp contract ogt <16 x float> %849, %164
  %851 = select contract <16 x i1> %850, <16 x float> %849, <16 x float> %164
  %852 = load float, ptr %771, align 4
  %853 = getelementptr inbounds i8, ptr %771, i64 4
  %854 = load float, ptr %853, align 4
  %855 = getelementptr inbounds i8, ptr %771, i64 8
  %856 = load float, ptr %855, align 4
  %857 = getelementptr inbounds i8, ptr %775, i64 576
  %858 = load <16 x float>, ptr %857, align 64
  %859 = load <16 x float>, ptr %775, align 64
  %860 = insertelement <16 x float> poison, float %852, i64 0
  %861 = shufflevector <16 x float> %860, <16 x float> poison, <16 x i32> zeroinitializer
  %862 = fmul contract <16 x float> %861, %859
  %863 = fadd contract <16 x float> %858, %862
  %864 = getelementptr inbounds i8, ptr %775, i64 64
  %865 = load <16 x float>, ptr %864, align 64
  %866 = insertelement <16 x float> poison, float %854, i64 0
  %867 = shufflevector <16 x float> %866, <16 x float> poison, <16 x i32> zeroinitializer
  %868 = fmul contract <16 x float> %867, %865
  %869 = fadd contract <16 x float> %863, %868
  %870 = getelementptr inbounds i8, ptr %775, i64 128
  %871 = load <16 x float>, ptr %870, align 64
  %872 = insertelement <16 x float> poison, float %856, i64 0
  %873 = shufflevector <16 x float> %872, <16 x float> poison, <16 x i32> zeroinitializer
  %874 = fmul contract <16 x float> %873, %871
  %875 = fadd contract <16 x float> %869, %874
  %876 = getelementptr inbounds i8, ptr %775, i64 640
  %877 = load <16 x float>, ptr %876, align 64
  %878 = getelementptr inbounds i8, ptr %775, i64 192
  %879 = load <16 x float>, ptr %878, align 64
  %880 = fmul contract <16 x float> %861, %879
  %881 = fadd contract <16 x float> %877, %880
  %882 = getelementptr inbounds i8, ptr %775, i64 256
  %883 = load <16 x float>, ptr %882, align 64
  %884 = fmul contract <16 x float> %867, %883
  %885 = fadd contract <16 x float> %881, %884
  %886 = getelementptr inbounds i8, ptr %775, i64 320
  %887 = load <16 x float>, ptr %886, align 64
  %888 = fmul contract <16 x float> %873, %887
  %889 = fadd contract <16 x float> %885, %888
  %890 = getelementptr inbounds i8, ptr %775, i64 704
  %891 = load <16 x float>, ptr %890, align 64
  %892 = getelementptr inbounds i8, ptr %775, i64 384
  %893 = load <16 x float>, ptr %892, align 64
  %894 = fmul contract <16 x float> %861, %893
  %895 = fadd contract <16 x float> %891, %894
  %896 = getelementptr inbounds i8, ptr %775, i64 448
  %897 = load <16 x float>, ptr %896, align 64
  %898 = fmul contract <16 x float> %867, %897
  %899 = fadd contract <16 x float> %895, %898
  %900 = getelementptr inbounds i8, ptr %775, i64 512
  %901 = load <16 x float>, ptr %900, align 64
  %902 = fmul contract <16 x float> %873, %901
  %903 = fadd contract <16 x float> %899, %902
  %904 = fsub contract <16 x float> %875, %813
  %905 = fsub contract <16 x float> %889, %827
  %906 = fsub contract <16 x float> %903, %841
  %907 = fmul contract <16 x float> %904, %904
  %908 = fmul contract <16 x float> %905, %905
  %909 = fadd contract <16 x float> %907, %908
  %910 = fmul contract <16 x float> %906, %906
  %911 = fadd contract <16 x float> %909, %910
  %912 = fmul contract <16 x float> %851, %851
  %913 = fcmp contract olt <16 x float> %911, %912
  %914 = bitcast <16 x i1> %913 to i16
  %915 = icmp eq i16 %914, 0
  br i1 %915, label %1263, label %916

916:
  call void @llvm.lifetime.start.p0(i64 16, ptr nonnull %7)
  store i64 %770, ptr %7, align 16
  store i64 %773, ptr %188, align 8
  br label %923

917:
  %918 = getelementptr inbounds i8, ptr %769, i64 16
  %919 = load i64, ptr %918, align 8
  %920 = getelementptr inbounds i8, ptr %769, i64 24
  %921 = load i64, ptr %920, align 8
  %922 = icmp slt i64 %919, %921
  br i1 %922, label %1004, label %1261

923:
  %924 = phi i64 [ %767, %916 ], [ %1001, %1000 ]
  %925 = phi i64 [ 0, %916 ], [ %1002, %1000 ]
  %926 = getelementptr inbounds i8, ptr %7, i64 %925
  %927 = load i64, ptr %926, align 8
  %928 = shl nuw i64 1, %927
  %929 = and i64 %928, %924
  %930 = icmp eq i64 %929, 0
  br i1 %930, label %931, label %1000

931:
  %932 = or i64 %928, %924
  %933 = getelementptr inbounds i64, ptr %190, i64 %927
  %934 = load i64, ptr %933, align 8
  %935 = getelementptr i8, ptr %933, i64 8
  %936 = load i64, ptr %935, align 8
  %937 = icmp slt i64 %934, %936
  br i1 %937, label %938, label %1000

938:
  %939 = getelementptr inbounds %struct.Frame, ptr %11, i64 %927
  %940 = getelementptr inbounds i8, ptr %939, i64 576
  %941 = load <16 x float>, ptr %940, align 64
  %942 = load <16 x float>, ptr %939, align 64
  %943 = getelementptr inbounds i8, ptr %939, i64 64
  %944 = load <16 x float>, ptr %943, align 64
  %945 = getelementptr inbounds i8, ptr %939, i64 128
  %946 = load <16 x float>, ptr %945, align 64
  %947 = getelementptr inbounds i8, ptr %939, i64 640
  %948 = load <16 x float>, ptr %947, align 64
  %949 = getelementptr inbounds i8, ptr %939, i64 192
  %950 = load <16 x float>, ptr %949, align 64
  %951 = getelementptr inbounds i8, ptr %939, i64 256
  %952 = load <16 x float>, ptr %951, align 64
  %953 = getelementptr inbounds i8, ptr %939, i64 320
  %954 = load <16 x float>, ptr %953, align 64
  %955 = getelementptr inbounds i8, ptr %939, i64 704
  %956 = load <16 x float>, ptr %955, align 64
  %957 = getelementptr inbounds i8, ptr %939, i64 384
  %958 = load <16 x float>, ptr %957, align 64
  %959 = getelementptr inbounds i8, ptr %939, i64 448
  %960 = load <16 x float>, ptr %959, align 64
  %961 = getelementptr inbounds i8, ptr %939, i64 512
  %962 = load <16 x float>, ptr %961, align 64
  br label %963

963:
  %964 = phi i64 [ %934, %938 ], [ %998, %963 ]
  %965 = getelementptr inbounds %struct.Part, ptr %192, i64 %964
  %966 = load float, ptr %965, align 4
  %967 = getelementptr inbounds i8, ptr %965, i64 4
  %968 = load float, ptr %967, align 4
  %969 = getelementptr inbounds i8, ptr %965, i64 8
  %970 = load float, ptr %969, align 4
  %971 = insertelement <16 x float> poison, float %966, i64 0
  %972 = shufflevector <16 x float> %971, <16 x float> poison, <16 x i32> zeroinitializer
  %973 = fmul contract <16 x float> %972, %942
  %974 = fadd contract <16 x float> %941, %973
  %975 = insertelement <16 x float> poison, float %968, i64 0
  %976 = shufflevector <16 x float> %975, <16 x float> poison, <16 x i32> zeroinitializer
  %977 = fmul contract <16 x float> %976, %944
  %978 = fadd contract <16 x float> %974, %977
  %979 = insertelement <16 x float> poison, float %970, i64 0
  %980 = shufflevector <16 x float> %979, <16 x float> poison, <16 x i32> zeroinitializer
  %981 = fmul contract <16 x float> %980, %946
  %982 = fadd contract <16 x float> %978, %981
  %983 = fmul contract <16 x float> %972, %950
  %984 = fadd contract <16 x float> %948, %983
  %985 = fmul contract <16 x float> %976, %952
  %986 = fadd contract <16 x float> %984, %985
  %987 = fmul contract <16 x float> %980, %954
  %988 = fadd contract <16 x float> %986, %987
  %989 = fmul contract <16 x float> %972, %958
  %990 = fadd contract <16 x float> %956, %989
  %991 = fmul contract <16 x float> %976, %960
  %992 = fadd contract <16 x float> %990, %991
  %993 = fmul contract <16 x float> %980, %962
  %994 = fadd contract <16 x float> %992, %993
  %995 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %964
  store <16 x float> %982, ptr %995, align 64
  %996 = getelementptr inbounds i8, ptr %995, i64 64
  store <16 x float> %988, ptr %996, align 64
  %997 = getelementptr inbounds i8, ptr %995, i64 128
  store <16 x float> %994, ptr %997, align 64
  %998 = add nsw i64 %964, 1
  %999 = icmp eq i64 %998, %936
  br i1 %999, label %1000, label %963

1000:
  %1001 = phi i64 [ %924, %923 ], [ %932, %931 ], [ %932, %963 ]
  %1002 = add nuw nsw i64 %925, 8
  %1003 = icmp eq i64 %1002, 16
  br i1 %1003, label %917, label %923

1004:
  %1005 = phi <16 x i32> [ %1258, %1255 ], [ %766, %917 ]
  %1006 = phi i64 [ %1259, %1255 ], [ %919, %917 ]
  %1007 = phi i1 [ %1256, %1255 ], [ false, %917 ]
  %1008 = phi i64 [ %1257, %1255 ], [ -1, %917 ]
  %1009 = getelementptr inbounds %struct.PartPair, ptr %194, i64 %1006
  %1010 = load i64, ptr %1009, align 8
  %1011 = getelementptr inbounds %struct.Part, ptr %192, i64 %1010
  %1012 = getelementptr inbounds i8, ptr %1009, i64 8
  %1013 = load i64, ptr %1012, align 8
  %1014 = getelementptr inbounds %struct.Part, ptr %192, i64 %1013
  %1015 = icmp eq i64 %1010, %1008
  br i1 %1015, label %1043, label %1016

1016:
  %1017 = getelementptr inbounds i8, ptr %1011, i64 28
  %1018 = load float, ptr %1017, align 4
  %1019 = fadd contract float %845, %1018
  %1020 = insertelement <16 x float> poison, float %1019, i64 0
  %1021 = shufflevector <16 x float> %1020, <16 x float> poison, <16 x i32> zeroinitializer
  %1022 = fadd contract <16 x float> %789, %1021
  %1023 = fcmp contract ogt <16 x float> %1022, %164
  %1024 = select contract <16 x i1> %1023, <16 x float> %1022, <16 x float> %164
  %1025 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %1010
  %1026 = load <16 x float>, ptr %1025, align 64
  %1027 = fsub contract <16 x float> %1026, %813
  %1028 = getelementptr inbounds i8, ptr %1025, i64 64
  %1029 = load <16 x float>, ptr %1028, align 64
  %1030 = fsub contract <16 x float> %1029, %827
  %1031 = getelementptr inbounds i8, ptr %1025, i64 128
  %1032 = load <16 x float>, ptr %1031, align 64
  %1033 = fsub contract <16 x float> %1032, %841
  %1034 = fmul contract <16 x float> %1027, %1027
  %1035 = fmul contract <16 x float> %1030, %1030
  %1036 = fadd contract <16 x float> %1034, %1035
  %1037 = fmul contract <16 x float> %1033, %1033
  %1038 = fadd contract <16 x float> %1036, %1037
  %1039 = fmul contract <16 x float> %1024, %1024
  %1040 = fcmp contract olt <16 x float> %1038, %1039
  %1041 = bitcast <16 x i1> %1040 to i16
  %1042 = icmp eq i16 %1041, 0
  br i1 %1042, label %1255, label %1044

1043:
  br i1 %1007, label %1044, label %1255

1044:
  %1045 = phi i64 [ %1010, %1016 ], [ %1008, %1043 ]
  %1046 = getelementptr inbounds i8, ptr %1011, i64 28
  %1047 = load float, ptr %1046, align 4
  %1048 = getelementptr inbounds i8, ptr %1014, i64 28
  %1049 = load float, ptr %1048, align 4
  %1050 = fadd contract float %1047, %1049
  %1051 = insertelement <16 x float> poison, float %1050, i64 0
  %1052 = shufflevector <16 x float> %1051, <16 x float> poison, <16 x i32> zeroinitializer
  %1053 = fadd contract <16 x float> %789, %1052
  %1054 = fcmp contract ogt <16 x float> %1053, %164
  %1055 = select contract <16 x i1> %1054, <16 x float> %1053, <16 x float> %164
  %1056 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %1010
  %1057 = getelementptr inbounds [192 x %struct.Point], ptr %6, i64 0, i64 %1013
  %1058 = load <16 x float>, ptr %1056, align 64
  %1059 = load <16 x float>, ptr %1057, align 64
  %1060 = fsub contract <16 x float> %1058, %1059
  %1061 = getelementptr inbounds i8, ptr %1056, i64 64
  %1062 = load <16 x float>, ptr %1061, align 64
  %1063 = getelementptr inbounds i8, ptr %1057, i64 64
  %1064 = load <16 x float>, ptr %1063, align 64
  %1065 = fsub contract <16 x float> %1062, %1064
  %1066 = getelementptr inbounds i8, ptr %1056, i64 128
  %1067 = load <16 x float>, ptr %1066, align 64
  %1068 = getelementptr inbounds i8, ptr %1057, i64 128
  %1069 = load <16 x float>, ptr %1068, align 64
  %1070 = fsub contract <16 x float> %1067, %1069
  %1071 = fmul contract <16 x float> %1060, %1060
  %1072 = fmul contract <16 x float> %1065, %1065
  %1073 = fadd contract <16 x float> %1071, %1072
  %1074 = fmul contract <16 x float> %1070, %1070
  %1075 = fadd contract <16 x float> %1073, %1074
  %1076 = fmul contract <16 x float> %1055, %1055
  %1077 = fcmp contract olt <16 x float> %1075, %1076
  %1078 = bitcast <16 x i1> %1077 to i16
  %1079 = icmp eq i16 %1078, 0
  br i1 %1079, label %1255, label %1080

1080:
  %1081 = getelementptr inbounds i8, ptr %1011, i64 24
  %1082 = load float, ptr %1081, align 4
  %1083 = getelementptr inbounds i8, ptr %1014, i64 24
  %1084 = load float, ptr %1083, align 4
  %1085 = fadd contract float %1082, %1084
  %1086 = insertelement <16 x float> poison, float %1085, i64 0
  %1087 = shufflevector <16 x float> %1086, <16 x float> poison, <16 x i32> zeroinitializer
  %1088 = fadd contract <16 x float> %789, %1087
  %1089 = fcmp contract ogt <16 x float> %1088, %164
  %1090 = select contract <16 x i1> %1089, <16 x float> %1088, <16 x float> %164
  %1091 = getelementptr inbounds i8, ptr %1011, i64 12
  %1092 = load float, ptr %1091, align 4
  %1093 = fmul contract float %1092, %1092
  %1094 = getelementptr inbounds i8, ptr %1011, i64 16
  %1095 = load float, ptr %1094, align 4
  %1096 = fmul contract float %1095, %1095
  %1097 = fadd contract float %1093, %1096
  %1098 = getelementptr inbounds i8, ptr %1011, i64 20
  %1099 = load float, ptr %1098, align 4
  %1100 = fmul contract float %1099, %1099
  %1101 = fadd contract float %1097, %1100
  %1102 = getelementptr inbounds i8, ptr %1014, i64 12
  %1103 = load float, ptr %1102, align 4
  %1104 = fmul contract float %1103, %1103
  %1105 = getelementptr inbounds i8, ptr %1014, i64 16
  %1106 = load float, ptr %1105, align 4
  %1107 = fmul contract float %1106, %1106
  %1108 = fadd contract float %1104, %1107
  %1109 = getelementptr inbounds i8, ptr %1014, i64 20
  %1110 = load float, ptr %1109, align 4
  %1111 = fmul contract float %1110, %1110
  %1112 = fadd contract float %1108, %1111
  %1113 = fcmp contract oeq float %1101, 0.000000e+00
  %1114 = fcmp contract oeq float %1112, 0.000000e+00
  %1115 = select i1 %1113, i1 %1114, i1 false
  br i1 %1115, label %1247, label %1116

1116:
  %1117 = fmul contract <16 x float> %1058, zeroinitializer
  %1118 = fadd contract <16 x float> %1117, <float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01, float 5.000000e-01>
  %1119 = insertelement <16 x float> poison, float %1092, i64 0
  %1120 = shufflevector <16 x float> %1119, <16 x float> poison, <16 x i32> zeroinitializer
  %1121 = fmul contract <16 x float> %859, %1120
  %1122 = insertelement <16 x float> poison, float %1095, i64 0
  %1123 = shufflevector <16 x float> %1122, <16 x float> poison, <16 x i32> zeroinitializer
  %1124 = fmul contract <16 x float> %865, %1123
  %1125 = fadd contract <16 x float> %1121, %1124
  %1126 = insertelement <16 x float> poison, float %1099, i64 0
  %1127 = shufflevector <16 x float> %1126, <16 x float> poison, <16 x i32> zeroinitializer
  %1128 = fmul contract <16 x float> %871, %1127
  %1129 = fadd contract <16 x float> %1125, %1128
  %1130 = fmul contract <16 x float> %879, %1120
  %1131 = fmul contract <16 x float> %883, %1123
  %1132 = fadd contract <16 x float> %1130, %1131
  %1133 = fmul contract <16 x float> %887, %1127
  %1134 = fadd contract <16 x float> %1132, %1133
  %1135 = fmul contract <16 x float> %893, %1120
  %1136 = fmul contract <16 x float> %897, %1123
  %1137 = fadd contract <16 x float> %1135, %1136
  %1138 = fmul contract <16 x float> %901, %1127
  %1139 = fadd contract <16 x float> %1137, %1138
  %1140 = insertelement <16 x float> poison, float %1103, i64 0
  %1141 = shufflevector <16 x float> %1140, <16 x float> poison, <16 x i32> zeroinitializer
  %1142 = fmul contract <16 x float> %797, %1141
  %1143 = insertelement <16 x float> poison, float %1106, i64 0
  %1144 = shufflevector <16 x float> %1143, <16 x float> poison, <16 x i32> zeroinitializer
  %1145 = fmul contract <16 x float> %803, %1144
  %1146 = fadd contract <16 x float> %1142, %1145
  %1147 = insertelement <16 x float> poison, float %1110, i64 0
  %1148 = shufflevector <16 x float> %1147, <16 x float> poison, <16 x i32> zeroinitializer
  %1149 = fmul contract <16 x float> %809, %1148
  %1150 = fadd contract <16 x float> %1146, %1149
  %1151 = fmul contract <16 x float> %817, %1141
  %1152 = fmul contract <16 x float> %821, %1144
  %1153 = fadd contract <16 x float> %1151, %1152
  %1154 = fmul contract <16 x float> %825, %1148
  %1155 = fadd contract <16 x float> %1153, %1154
  %1156 = fmul contract <16 x float> %831, %1141
  %1157 = fmul contract <16 x float> %835, %1144
  %1158 = fadd contract <16 x float> %1156, %1157
  %1159 = fmul contract <16 x float> %839, %1148
  %1160 = fadd contract <16 x float> %1158, %1159
  %1161 = fcmp contract ogt float %1101, 0.000000e+00
  %1162 = fdiv contract float 1.000000e+00, %1101
  %1163 = select contract i1 %1161, float %1162, float 0.000000e+00
  %1164 = fcmp contract ogt float %1112, 0.000000e+00
  %1165 = fdiv contract float 1.000000e+00, %1112
  %1166 = select contract i1 %1164, float %1165, float 0.000000e+00
  %1167 = fmul contract <16 x float> %1129, %1150
  %1168 = fmul contract <16 x float> %1134, %1155
  %1169 = fadd contract <16 x float> %1167, %1168
  %1170 = fmul contract <16 x float> %1139, %1160
  %1171 = fadd contract <16 x float> %1170, %1169
  %1172 = fmul contract <16 x float> %1060, %1129
  %1173 = fmul contract <16 x float> %1065, %1134
  %1174 = fadd contract <16 x float> %1172, %1173
  %1175 = fmul contract <16 x float> %1070, %1139
  %1176 = fadd contract <16 x float> %1175, %1174
  %1177 = fmul contract <16 x float> %1060, %1150
  %1178 = fmul contract <16 x float> %1065, %1155
  %1179 = fadd contract <16 x float> %1177, %1178
  %1180 = fmul contract <16 x float> %1070, %1160
  %1181 = fadd contract <16 x float> %1180, %1179
  %1182 = fmul contract float %1101, %1112
  %1183 = insertelement <16 x float> poison, float %1182, i64 0
  %1184 = shufflevector <16 x float> %1183, <16 x float> poison, <16 x i32> zeroinitializer
  %1185 = fmul contract <16 x float> %1171, %1171
  %1186 = fsub contract <16 x float> %1184, %1185
  %1187 = fmul contract float %1101, 0x3E7AD7F2A0000000
  %1188 = fmul contract float %1187, %1112
  %1189 = insertelement <16 x float> poison, float %1188, i64 0
  %1190 = shufflevector <16 x float> %1189, <16 x float> poison, <16 x i32> zeroinitializer
  %1191 = fcmp contract ogt <16 x float> %1186, %1190
  %1192 = fmul contract <16 x float> %1171, %1181
  %1193 = insertelement <16 x float> poison, float %1112, i64 0
  %1194 = shufflevector <16 x float> %1193, <16 x float> poison, <16 x i32> zeroinitializer
  %1195 = fmul contract <16 x float> %1194, %1176
  %1196 = fsub contract <16 x float> %1192, %1195
  %1197 = select contract <16 x i1> %1191, <16 x float> %1186, <16 x float> %1118
  %1198 = fdiv contract <16 x float> %1196, %1197
  %1199 = fneg contract <16 x float> %1118
  %1200 = fcmp contract ogt <16 x float> %1198, %1199
  %1201 = select contract <16 x i1> %1200, <16 x float> %1198, <16 x float> %1199
  %1202 = fcmp contract olt <16 x float> %1201, %1118
  %1203 = select contract <16 x i1> %1202, <16 x float> %1201, <16 x float> %1118
  %1204 = select contract <16 x i1> %1191, <16 x float> %1203, <16 x float> %1199
  %1205 = fmul contract <16 x float> %1171, %1204
  %1206 = fadd contract <16 x float> %1181, %1205
  %1207 = insertelement <16 x float> poison, float %1166, i64 0
  %1208 = shufflevector <16 x float> %1207, <16 x float> poison, <16 x i32> zeroinitializer
  %1209 = fmul contract <16 x float> %1208, %1206
  %1210 = fcmp contract ogt <16 x float> %1209, %1199
  %1211 = select contract <16 x i1> %1210, <16 x float> %1209, <16 x float> %1199
  %1212 = fcmp contract olt <16 x float> %1211, %1118
  %1213 = select contract <16 x i1> %1212, <16 x float> %1211, <16 x float> %1118
  %1214 = fmul contract <16 x float> %1171, %1213
  %1215 = fsub contract <16 x float> %1214, %1176
  %1216 = insertelement <16 x float> poison, float %1163, i64 0
  %1217 = shufflevector <16 x float> %1216, <16 x float> poison, <16 x i32> zeroinitializer
  %1218 = fmul contract <16 x float> %1217, %1215
  %1219 = fcmp contract ogt <16 x float> %1218, %1199
  %1220 = select contract <16 x i1> %1219, <16 x float> %1218, <16 x float> %1199
  %1221 = fcmp contract olt <16 x float> %1220, %1118
  %1222 = select contract <16 x i1> %1221, <16 x float> %1220, <16 x float> %1118
  %1223 = fmul contract <16 x float> %1171, %1222
  %1224 = fadd contract <16 x float> %1181, %1223
  %1225 = fmul contract <16 x float> %1208, %1224
  %1226 = fcmp contract ogt <16 x float> %1225, %1199
  %1227 = select contract <16 x i1> %1226, <16 x float> %1225, <16 x float> %1199
  %1228 = fcmp contract olt <16 x float> %1227, %1118
  %1229 = select contract <16 x i1> %1228, <16 x float> %1227, <16 x float> %1118
  %1230 = fmul contract <16 x float> %1129, %1222
  %1231 = fadd contract <16 x float> %1060, %1230
  %1232 = fmul contract <16 x float> %1150, %1229
  %1233 = fsub contract <16 x float> %1231, %1232
  %1234 = fmul contract <16 x float> %1134, %1222
  %1235 = fadd contract <16 x float> %1065, %1234
  %1236 = fmul contract <16 x float> %1155, %1229
  %1237 = fsub contract <16 x float> %1235, %1236
  %1238 = fmul contract <16 x float> %1139, %1222
  %1239 = fadd contract <16 x float> %1070, %1238
  %1240 = fmul contract <16 x float> %1160, %1229
  %1241 = fsub contract <16 x float> %1239, %1240
  %1242 = fmul contract <16 x float> %1233, %1233
  %1243 = fmul contract <16 x float> %1237, %1237
  %1244 = fadd contract <16 x float> %1242, %1243
  %1245 = fmul contract <16 x float> %1241, %1241
  %1246 = fadd contract <16 x float> %1245, %1244
  br label %1247

1247:
  %1248 = phi <16 x float> [ %1246, %1116 ], [ %1075, %1080 ]
  %1249 = fmul contract <16 x float> %1090, %1090
  %1250 = fcmp contract olt <16 x float> %1248, %1249
  %1251 = select <16 x i1> %1250, <16 x i32> <i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1, i32 -1>, <16 x i32> %1005
  %1252 = icmp ne <16 x i32> %1251, zeroinitializer
  %1253 = bitcast <16 x i1> %1252 to i16
  %1254 = icmp eq i16 %1253, 0
  br i1 %1254, label %1255, label %1268

1255:
  %1256 = phi i1 [ true, %1044 ], [ false, %1043 ], [ true, %1247 ], [ false, %1016 ]
  %1257 = phi i64 [ %1045, %1044 ], [ %1008, %1043 ], [ %1045, %1247 ], [ %1010, %1016 ]
  %1258 = phi <16 x i32> [ %1005, %1044 ], [ %1005, %1043 ], [ %1251, %1247 ], [ %1005, %1016 ]
  %1259 = add i64 %1006, 1
  %1260 = icmp eq i64 %1259, %921
  br i1 %1260, label %1261, label %1004

1261:
  %1262 = phi <16 x i32> [ %766, %917 ], [ %1258, %1255 ]
  call void @llvm.lifetime.end.p0(i64 16, ptr nonnull %7)
  br label %1263

1263:
  %1264 = phi <16 x i32> [ %1262, %1261 ], [ %766, %765 ]
  %1265 = phi i64 [ %1001, %1261 ], [ %767, %765 ]
  %1266 = add nuw nsw i64 %768, 1
  %1267 = icmp eq i64 %1266, %21
  br i1 %1267, label %1269, label %765

1268:
  call void @llvm.lifetime.end.p0(i64 16, ptr nonnull %7)
  br label %1269

1269:
  %1270 = phi <16 x i32> [ %1251, %1268 ], [ %764, %763 ], [ %1264, %1263 ]
  call void @llvm.lifetime.end.p0(i64 36864, ptr nonnull %6)
  br label %1271

1271:
  %1272 = phi <16 x i32> [ %1270, %1269 ], [ %746, %742 ], [ %751, %750 ]
  %1273 = icmp ne <16 x i32> %1272, zeroinitializer
  %1274 = bitcast <16 x i1> %1273 to i16
  %1275 = icmp eq i16 %1274, 0
  br i1 %1275, label %204, label %1276

1276:
  %1277 = phi i1 [ true, %153 ], [ %206, %204 ], [ %209, %1271 ]
  call void @llvm.lifetime.end.p0(i64 13056, ptr nonnull %11)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %10)
  call void @llvm.lifetime.end.p0(i64 1224, ptr nonnull %9)
  ret i1 %1277
}

declare void @llvm.lifetime.end.p0(i64 immarg, ptr nocapture)

define void @prove_edges(ptr nocapture noundef readonly %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, ptr nocapture noundef readonly %3, i64 noundef %4, double noundef %5, ptr nocapture noundef writeonly %6) {
  %8 = alloca [192 x %struct.Point.4], align 64
  %9 = alloca [2 x i64], align 16
  %10 = alloca [9 x <8 x double>], align 64
  %11 = alloca %struct.Motion.1, align 8
  %12 = alloca [4096 x %struct.Piece], align 16
  %13 = alloca [17 x %struct.Frame.2], align 64
  %14 = alloca [8 x %struct.Piece], align 16
  %15 = load i64, ptr %0, align 8
  %16 = icmp sgt i64 %4, 0
  br i1 %16, label %17, label %39

17:
  %18 = getelementptr inbounds i8, ptr %0, i64 112
  %19 = getelementptr inbounds i8, ptr %11, i64 136
  %20 = getelementptr inbounds i8, ptr %0, i64 16
  %21 = getelementptr inbounds i8, ptr %0, i64 120
  %22 = getelementptr inbounds i8, ptr %11, i64 272
  %23 = getelementptr inbounds i8, ptr %11, i64 1360
  %24 = getelementptr inbounds i8, ptr %13, i64 576
  %25 = getelementptr inbounds i8, ptr %0, i64 24
  %26 = getelementptr inbounds i8, ptr %0, i64 48
  %27 = getelementptr inbounds i8, ptr %0, i64 8
  %28 = getelementptr inbounds i8, ptr %0, i64 56
  %29 = getelementptr inbounds i8, ptr %0, i64 64
  %30 = getelementptr inbounds i8, ptr %0, i64 32
  %31 = getelementptr inbounds i8, ptr %0, i64 40
  %32 = getelementptr inbounds i8, ptr %0, i64 96
  %33 = getelementptr inbounds i8, ptr %0, i64 88
  %34 = getelementptr inbounds i8, ptr %0, i64 128
  %35 = getelementptr inbounds i8, ptr %9, i64 8
  %36 = getelementptr inbounds i8, ptr %0, i64 80
  %37 = getelementptr inbounds i8, ptr %0, i64 72
  %38 = getelementptr inbounds i8, ptr %0, i64 104
  br label %40

39:
  ret void

40:
  %41 = phi i64 [ 0, %17 ], [ %1321, %1318 ]
  %42 = mul nsw i64 %41, %15
  %43 = getelementptr inbounds double, ptr %1, i64 %42
  %44 = getelementptr inbounds double, ptr %2, i64 %42
  %45 = getelementptr inbounds double, ptr %3, i64 %42
  call void @llvm.lifetime.start.p0(i64 2448, ptr nonnull %11)
  %46 = load i64, ptr %0, align 8
  %47 = icmp slt i64 %46, 0
  br i1 %47, label %51, label %48

48:
  %49 = icmp eq i64 %46, 0
  %50 = load ptr, ptr %18, align 8
  br label %57

51:
  %52 = load i64, ptr %20, align 8
  %53 = icmp sgt i64 %52, 0
  br i1 %53, label %54, label %139

54:
  %55 = icmp sgt i64 %46, 0
  %56 = load ptr, ptr %21, align 8
  br label %98

57:
  %58 = phi i64 [ 0, %48 ], [ %96, %93 ]
  %59 = mul nuw nsw i64 %58, %46
  %60 = getelementptr inbounds double, ptr %50, i64 %59
  br i1 %49, label %61, label %63

61:
  %62 = getelementptr inbounds [17 x double], ptr %11, i64 0, i64 %58
  store double 0.000000e+00, ptr %62, align 8
  br label %93

63:
  %64 = phi i64 [ %75, %63 ], [ 0, %57 ]
  %65 = phi double [ %74, %63 ], [ 0.000000e+00, %57 ]
  %66 = getelementptr inbounds double, ptr %60, i64 %64
  %67 = load double, ptr %66, align 8
  %68 = getelementptr inbounds double, ptr %44, i64 %64
  %69 = load double, ptr %68, align 8
  %70 = fcmp contract olt double %69, 0.000000e+00
  %71 = fneg contract double %69
  %72 = select contract i1 %70, double %71, double %69
  %73 = fmul contract double %67, %72
  %74 = fadd contract double %65, %73
  %75 = add nuw nsw i64 %64, 1
  %76 = icmp eq i64 %75, %46
  br i1 %76, label %77, label %63

77:
  %78 = getelementptr inbounds [17 x double], ptr %11, i64 0, i64 %58
  store double %74, ptr %78, align 8
  br label %79

79:
  %80 = phi i64 [ %91, %79 ], [ 0, %77 ]
  %81 = phi double [ %90, %79 ], [ 0.000000e+00, %77 ]
  %82 = getelementptr inbounds double, ptr %60, i64 %80
  %83 = load double, ptr %82, align 8
  %84 = getelementptr inbounds double, ptr %45, i64 %80
  %85 = load double, ptr %84, align 8
  %86 = fcmp contract olt double %85, 0.000000e+00
  %87 = fneg contract double %85
  %88 = select contract i1 %86, double %87, double %85
  %89 = fmul contract double %83, %88
  %90 = fadd contract double %81, %89
  %91 = add nuw nsw i64 %80, 1
  %92 = icmp eq i64 %91, %46
  br i1 %92, label %93, label %79

93:
  %94 = phi double [ 0.000000e+00, %61 ], [ %90, %79 ]
  %95 = getelementptr inbounds [17 x double], ptr %19, i64 0, i64 %58
  store double %94, ptr %95, align 8
  %96 = add nuw i64 %58, 1
  %97 = icmp eq i64 %58, %46
  br i1 %97, label %51, label %57

98:
  %99 = phi i64 [ 0, %54 ], [ %137, %134 ]
  %100 = mul nsw i64 %99, %46
  %101 = getelementptr inbounds double, ptr %56, i64 %100
  br i1 %55, label %104, label %102

102:
  %103 = getelementptr inbounds [136 x double], ptr %22, i64 0, i64 %99
  store double 0.000000e+00, ptr %103, align 8
  br label %134

104:
  %105 = phi i64 [ %116, %104 ], [ 0, %98 ]
  %106 = phi double [ %115, %104 ], [ 0.000000e+00, %98 ]
  %107 = getelementptr inbounds double, ptr %101, i64 %105
  %108 = load double, ptr %107, align 8
  %109 = getelementptr inbounds double, ptr %44, i64 %105
  %110 = load double, ptr %109, align 8
  %111 = fcmp contract olt double %110, 0.000000e+00
  %112 = fneg contract double %110
  %113 = select contract i1 %111, double %112, double %110
  %114 = fmul contract double %108, %113
  %115 = fadd contract double %106, %114
  %116 = add nuw nsw i64 %105, 1
  %117 = icmp eq i64 %116, %46
  br i1 %117, label %118, label %104

118:
  %119 = getelementptr inbounds [136 x double], ptr %22, i64 0, i64 %99
  store double %115, ptr %119, align 8
  br label %120

120:
  %121 = phi i64 [ %132, %120 ], [ 0, %118 ]
  %122 = phi double [ %131, %120 ], [ 0.000000e+00, %118 ]
  %123 = getelementptr inbounds double, ptr %101, i64 %121
  %124 = load double, ptr %123, align 8
  %125 = getelementptr inbounds double, ptr %45, i64 %121
  %126 = load double, ptr %125, align 8
  %127 = fcmp contract olt double %126, 0.000000e+00
  %128 = fneg contract double %126
  %129 = select contract i1 %127, double %128, double %126
  %130 = fmul contract double %124, %129
  %131 = fadd contract double %122, %130
  %132 = add nuw nsw i64 %121, 1
  %133 = icmp eq i64 %132, %46
  br i1 %133, label %134, label %120

134:
  %135 = phi double [ 0.000000e+00, %102 ], [ %131, %120 ]
  %136 = getelementptr inbounds [136 x double], ptr %23, i64 0, i64 %99
  store double %135, ptr %136, align 8
  %137 = add nuw nsw i64 %99, 1
  %138 = icmp eq i64 %137, %52
  br i1 %138, label %139, label %98

139:
  br i1 %47, label %140, label %142

140:
  %141 = phi double [ 0.000000e+00, %139 ], [ %148, %142 ]
  br i1 %53, label %151, label %160

142:
  %143 = phi i64 [ %149, %142 ], [ 0, %139 ]
  %144 = phi double [ %148, %142 ], [ 0.000000e+00, %139 ]
  %145 = getelementptr inbounds [17 x double], ptr %11, i64 0, i64 %143
  %146 = load double, ptr %145, align 8
  %147 = fcmp contract ogt double %146, %144
  %148 = select i1 %147, double %146, double %144
  %149 = add nuw i64 %143, 1
  %150 = icmp eq i64 %143, %46
  br i1 %150, label %140, label %142

151:
  %152 = phi i64 [ %158, %151 ], [ 0, %140 ]
  %153 = phi double [ %157, %151 ], [ %141, %140 ]
  %154 = getelementptr inbounds [136 x double], ptr %22, i64 0, i64 %152
  %155 = load double, ptr %154, align 8
  %156 = fcmp contract ogt double %155, %153
  %157 = select i1 %156, double %155, double %153
  %158 = add nuw nsw i64 %152, 1
  %159 = icmp eq i64 %158, %52
  br i1 %159, label %160, label %151

160:
  %161 = phi double [ %141, %140 ], [ %157, %151 ]
  call void @llvm.lifetime.start.p0(i64 65536, ptr nonnull %12)
  br label %178

162:
  call void @llvm.lifetime.start.p0(i64 13056, ptr nonnull %13)
  %163 = icmp sgt i64 %46, 0
  %164 = load ptr, ptr %25, align 8
  %165 = load ptr, ptr %26, align 8
  %166 = load i64, ptr %27, align 8
  %167 = icmp sgt i64 %166, 0
  %168 = load ptr, ptr %28, align 8
  %169 = load ptr, ptr %29, align 8
  %170 = load ptr, ptr %30, align 8
  %171 = load ptr, ptr %31, align 8
  %172 = load ptr, ptr %32, align 8
  %173 = load ptr, ptr %33, align 8
  %174 = load ptr, ptr %34, align 8
  %175 = load ptr, ptr %36, align 8
  %176 = load ptr, ptr %37, align 8
  %177 = load ptr, ptr %38, align 8
  br label %188

178:
  %179 = phi i64 [ 0, %160 ], [ %184, %178 ]
  %180 = uitofp nneg i64 %179 to double
  %181 = fmul contract double %180, 2.000000e+00
  %182 = fadd contract double %181, 1.000000e+00
  %183 = fmul contract double %182, 6.250000e-02
  %184 = add nuw nsw i64 %179, 1
  %185 = getelementptr inbounds [4096 x %struct.Piece], ptr %12, i64 0, i64 %179
  store double %183, ptr %185, align 16
  %186 = getelementptr inbounds i8, ptr %185, i64 8
  store double 6.250000e-02, ptr %186, align 8
  %187 = icmp eq i64 %184, 8
  br i1 %187, label %162, label %178

188:
  %189 = phi i64 [ 8, %162 ], [ %1316, %1315 ]
  %190 = phi <8 x double> [ undef, %162 ], [ %1279, %1315 ]
  %191 = phi <8 x double> [ undef, %162 ], [ %1282, %1315 ]
  call void @llvm.lifetime.start.p0(i64 128, ptr nonnull %14)
  br label %1268

192:
  %193 = fmul contract <8 x double> %1279, zeroinitializer
  br label %194

194:
  %195 = phi i64 [ 0, %192 ], [ %203, %194 ]
  %196 = and i64 %195, 3
  %197 = icmp eq i64 %196, 0
  %198 = uitofp i1 %197 to double
  %199 = insertelement <8 x double> poison, double %198, i64 0
  %200 = shufflevector <8 x double> %199, <8 x double> poison, <8 x i32> zeroinitializer
  %201 = fadd contract <8 x double> %193, %200
  %202 = getelementptr inbounds [9 x <8 x double>], ptr %13, i64 0, i64 %195
  store <8 x double> %201, ptr %202, align 64
  %203 = add nuw nsw i64 %195, 1
  %204 = icmp eq i64 %203, 9
  br i1 %204, label %210, label %194

205:
  %206 = tail call i64 @llvm.smin.i64(i64 %189, i64 8)
  %207 = sub nsw i64 %189, %206
  br i1 %163, label %215, label %208

208:
  %209 = fmul contract <8 x double> %1282, zeroinitializer
  br label %755

210:
  %211 = phi i64 [ %213, %210 ], [ 0, %194 ]
  %212 = getelementptr inbounds [3 x <8 x double>], ptr %24, i64 0, i64 %211
  store <8 x double> %193, ptr %212, align 64
  %213 = add nuw nsw i64 %211, 1
  %214 = icmp eq i64 %213, 3
  br i1 %214, label %205, label %210

215:
  %216 = phi i64 [ %272, %425 ], [ 0, %205 ]
  %217 = getelementptr inbounds %struct.Joint.3, ptr %164, i64 %216
  %218 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %216
  %219 = getelementptr inbounds double, ptr %43, i64 %216
  %220 = load double, ptr %219, align 8
  %221 = getelementptr inbounds double, ptr %44, i64 %216
  %222 = load double, ptr %221, align 8
  %223 = insertelement <8 x double> poison, double %222, i64 0
  %224 = shufflevector <8 x double> %223, <8 x double> poison, <8 x i32> zeroinitializer
  %225 = getelementptr inbounds i8, ptr %217, i64 72
  %226 = load double, ptr %225, align 8
  %227 = getelementptr inbounds i8, ptr %217, i64 80
  %228 = load double, ptr %227, align 8
  %229 = getelementptr inbounds i8, ptr %217, i64 88
  %230 = load double, ptr %229, align 8
  %231 = getelementptr inbounds i8, ptr %218, i64 576
  %232 = load <8 x double>, ptr %231, align 64
  %233 = load <8 x double>, ptr %218, align 64
  %234 = insertelement <8 x double> poison, double %226, i64 0
  %235 = shufflevector <8 x double> %234, <8 x double> poison, <8 x i32> zeroinitializer
  %236 = getelementptr inbounds i8, ptr %218, i64 64
  %237 = load <8 x double>, ptr %236, align 64
  %238 = insertelement <8 x double> poison, double %228, i64 0
  %239 = shufflevector <8 x double> %238, <8 x double> poison, <8 x i32> zeroinitializer
  %240 = getelementptr inbounds i8, ptr %218, i64 128
  %241 = load <8 x double>, ptr %240, align 64
  %242 = insertelement <8 x double> poison, double %230, i64 0
  %243 = shufflevector <8 x double> %242, <8 x double> poison, <8 x i32> zeroinitializer
  %244 = getelementptr inbounds i8, ptr %218, i64 640
  %245 = load <8 x double>, ptr %244, align 64
  %246 = getelementptr inbounds i8, ptr %218, i64 192
  %247 = load <8 x double>, ptr %246, align 64
  %248 = getelementptr inbounds i8, ptr %218, i64 256
  %249 = load <8 x double>, ptr %248, align 64
  %250 = getelementptr inbounds i8, ptr %218, i64 320
  %251 = load <8 x double>, ptr %250, align 64
  %252 = getelementptr inbounds i8, ptr %218, i64 704
  %253 = load <8 x double>, ptr %252, align 64
  %254 = getelementptr inbounds i8, ptr %218, i64 384
  %255 = load <8 x double>, ptr %254, align 64
  %256 = getelementptr inbounds i8, ptr %218, i64 448
  %257 = load <8 x double>, ptr %256, align 64
  %258 = getelementptr inbounds i8, ptr %218, i64 512
  %259 = load <8 x double>, ptr %258, align 64
  call void @llvm.lifetime.start.p0(i64 576, ptr nonnull %10)
  br label %260

260:
  %261 = phi i64 [ 0, %215 ], [ %303, %302 ]
  %262 = mul nuw nsw i64 %261, 3
  %263 = getelementptr inbounds [9 x <8 x double>], ptr %218, i64 0, i64 %262
  %264 = load <8 x double>, ptr %263, align 64
  %265 = add nuw nsw i64 %262, 1
  %266 = getelementptr inbounds [9 x <8 x double>], ptr %218, i64 0, i64 %265
  %267 = load <8 x double>, ptr %266, align 64
  %268 = add nuw nsw i64 %262, 2
  %269 = getelementptr inbounds [9 x <8 x double>], ptr %218, i64 0, i64 %268
  %270 = load <8 x double>, ptr %269, align 64
  br label %305

271:
  %272 = add nuw nsw i64 %216, 1
  %273 = insertelement <8 x double> poison, double %220, i64 0
  %274 = fmul contract <8 x double> %1279, %224
  %275 = fmul contract <8 x double> %235, %233
  %276 = fmul contract <8 x double> %239, %237
  %277 = fmul contract <8 x double> %243, %241
  %278 = fmul contract <8 x double> %235, %247
  %279 = fmul contract <8 x double> %239, %249
  %280 = fmul contract <8 x double> %243, %251
  %281 = fmul contract <8 x double> %235, %255
  %282 = fmul contract <8 x double> %239, %257
  %283 = fmul contract <8 x double> %243, %259
  %284 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %272
  %285 = shufflevector <8 x double> %273, <8 x double> poison, <8 x i32> zeroinitializer
  %286 = fadd contract <8 x double> %285, %274
  %287 = fadd contract <8 x double> %232, %275
  %288 = fadd contract <8 x double> %287, %276
  %289 = fadd contract <8 x double> %288, %277
  %290 = fadd contract <8 x double> %245, %278
  %291 = fadd contract <8 x double> %290, %279
  %292 = fadd contract <8 x double> %291, %280
  %293 = fadd contract <8 x double> %253, %281
  %294 = fadd contract <8 x double> %293, %282
  %295 = fadd contract <8 x double> %294, %283
  %296 = getelementptr inbounds i8, ptr %284, i64 576
  store <8 x double> %289, ptr %296, align 64
  %297 = getelementptr inbounds i8, ptr %284, i64 640
  store <8 x double> %292, ptr %297, align 64
  %298 = getelementptr inbounds i8, ptr %284, i64 704
  store <8 x double> %295, ptr %298, align 64
  %299 = getelementptr inbounds i8, ptr %217, i64 96
  %300 = load double, ptr %299, align 8
  %301 = fcmp contract une double %300, 0.000000e+00
  br i1 %301, label %330, label %349

302:
  %303 = add nuw nsw i64 %261, 1
  %304 = icmp eq i64 %303, 3
  br i1 %304, label %271, label %260

305:
  %306 = phi i64 [ 0, %260 ], [ %328, %305 ]
  %307 = getelementptr inbounds [9 x double], ptr %217, i64 0, i64 %306
  %308 = load double, ptr %307, align 8
  %309 = insertelement <8 x double> poison, double %308, i64 0
  %310 = shufflevector <8 x double> %309, <8 x double> poison, <8 x i32> zeroinitializer
  %311 = fmul contract <8 x double> %264, %310
  %312 = add nuw nsw i64 %306, 3
  %313 = getelementptr inbounds [9 x double], ptr %217, i64 0, i64 %312
  %314 = load double, ptr %313, align 8
  %315 = insertelement <8 x double> poison, double %314, i64 0
  %316 = shufflevector <8 x double> %315, <8 x double> poison, <8 x i32> zeroinitializer
  %317 = fmul contract <8 x double> %267, %316
  %318 = fadd contract <8 x double> %311, %317
  %319 = add nuw nsw i64 %306, 6
  %320 = getelementptr inbounds [9 x double], ptr %217, i64 0, i64 %319
  %321 = load double, ptr %320, align 8
  %322 = insertelement <8 x double> poison, double %321, i64 0
  %323 = shufflevector <8 x double> %322, <8 x double> poison, <8 x i32> zeroinitializer
  %324 = fmul contract <8 x double> %270, %323
  %325 = fadd contract <8 x double> %318, %324
  %326 = add nuw nsw i64 %306, %262
  %327 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %326
  store <8 x double> %325, ptr %327, align 64
  %328 = add nuw nsw i64 %306, 1
  %329 = icmp eq i64 %328, 3
  br i1 %329, label %302, label %305

330:
  %331 = phi i64 [ %335, %330 ], [ 0, %271 ]
  %332 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %331
  %333 = load <8 x double>, ptr %332, align 64
  %334 = getelementptr inbounds [9 x <8 x double>], ptr %284, i64 0, i64 %331
  store <8 x double> %333, ptr %334, align 64
  %335 = add nuw nsw i64 %331, 1
  %336 = icmp eq i64 %335, 9
  br i1 %336, label %337, label %330

337:
  %338 = phi i64 [ %347, %337 ], [ 0, %330 ]
  %339 = mul nuw nsw i64 %338, 3
  %340 = add nuw nsw i64 %339, 2
  %341 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %340
  %342 = load <8 x double>, ptr %341, align 64
  %343 = fmul contract <8 x double> %286, %342
  %344 = getelementptr inbounds [3 x <8 x double>], ptr %296, i64 0, i64 %338
  %345 = load <8 x double>, ptr %344, align 64
  %346 = fadd contract <8 x double> %345, %343
  store <8 x double> %346, ptr %344, align 64
  %347 = add nuw nsw i64 %338, 1
  %348 = icmp eq i64 %347, 3
  br i1 %348, label %425, label %337

349:
  %350 = fmul contract <8 x double> %286, <double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883, double 0x3FD45F306DC9C883>
  %351 = fadd contract <8 x double> %350, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %352 = fadd contract <8 x double> %351, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %353 = fmul contract <8 x double> %352, <double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000, double 0x400921FB54400000>
  %354 = fsub contract <8 x double> %286, %353
  %355 = fmul contract <8 x double> %352, <double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000, double 0x3DE0B4611A600000>
  %356 = fsub contract <8 x double> %354, %355
  %357 = fmul contract <8 x double> %352, <double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925, double 0x3BB3198A2E071925>
  %358 = fsub contract <8 x double> %356, %357
  %359 = fmul contract <8 x double> %352, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %360 = fadd contract <8 x double> %359, <double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000, double 0x4338000000000000>
  %361 = fadd contract <8 x double> %360, <double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000, double 0xC338000000000000>
  %362 = fsub contract <8 x double> %359, %361
  %363 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %362)
  %364 = fmul contract <8 x double> %363, <double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00, double 4.000000e+00>
  %365 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %364
  %366 = fmul contract <8 x double> %358, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %367 = fmul contract <8 x double> %366, %366
  %368 = fmul contract <8 x double> %366, %367
  %369 = fmul contract <8 x double> %367, <double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C, double 0x3DE5D93A5ACFD57C>
  %370 = fadd contract <8 x double> %369, <double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB, double 0xBE5AE5E68A2B9CEB>
  %371 = fmul contract <8 x double> %367, %370
  %372 = fadd contract <8 x double> %371, <double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D, double 0x3EC71DE357B1FE7D>
  %373 = fmul contract <8 x double> %367, %372
  %374 = fadd contract <8 x double> %373, <double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5, double 0xBF2A01A019C161D5>
  %375 = fmul contract <8 x double> %367, %374
  %376 = fadd contract <8 x double> %375, <double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6, double 0x3F8111111110F8A6>
  %377 = fmul contract <8 x double> %367, %376
  %378 = fadd contract <8 x double> %377, <double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549, double 0xBFC5555555555549>
  %379 = fmul contract <8 x double> %368, %378
  %380 = fadd contract <8 x double> %366, %379
  %381 = fmul contract <8 x double> %367, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %382 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %381
  %383 = fmul contract <8 x double> %367, %367
  %384 = fmul contract <8 x double> %367, <double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4, double 0x3DA8FAE9BE8838D4>
  %385 = fsub contract <8 x double> <double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4, double 0x3E21EE9EBDB4B1C4>, %384
  %386 = fmul contract <8 x double> %367, %385
  %387 = fadd contract <8 x double> %386, <double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD, double 0xBE927E4F809C52AD>
  %388 = fmul contract <8 x double> %367, %387
  %389 = fadd contract <8 x double> %388, <double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590, double 0x3EFA01A019CB1590>
  %390 = fmul contract <8 x double> %367, %389
  %391 = fadd contract <8 x double> %390, <double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177, double 0xBF56C16C16C15177>
  %392 = fmul contract <8 x double> %367, %391
  %393 = fadd contract <8 x double> %392, <double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C, double 0x3FA555555555554C>
  %394 = fmul contract <8 x double> %383, %393
  %395 = fadd contract <8 x double> %382, %394
  %396 = fmul contract <8 x double> %365, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %397 = fmul contract <8 x double> %396, %380
  %398 = fmul contract <8 x double> %395, %397
  %399 = fmul contract <8 x double> %380, <double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00, double 2.000000e+00>
  %400 = fmul contract <8 x double> %380, %399
  %401 = fsub contract <8 x double> <double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00, double 1.000000e+00>, %400
  %402 = fmul contract <8 x double> %365, %401
  br label %403

403:
  %404 = phi i64 [ 0, %349 ], [ %423, %403 ]
  %405 = mul nuw nsw i64 %404, 3
  %406 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %405
  %407 = load <8 x double>, ptr %406, align 64
  %408 = fmul contract <8 x double> %402, %407
  %409 = add nuw nsw i64 %405, 1
  %410 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %409
  %411 = load <8 x double>, ptr %410, align 64
  %412 = fmul contract <8 x double> %398, %411
  %413 = fadd contract <8 x double> %408, %412
  %414 = getelementptr inbounds [9 x <8 x double>], ptr %284, i64 0, i64 %405
  store <8 x double> %413, ptr %414, align 64
  %415 = fmul contract <8 x double> %402, %411
  %416 = fmul contract <8 x double> %398, %407
  %417 = fsub contract <8 x double> %415, %416
  %418 = getelementptr inbounds [9 x <8 x double>], ptr %284, i64 0, i64 %409
  store <8 x double> %417, ptr %418, align 64
  %419 = add nuw nsw i64 %405, 2
  %420 = getelementptr inbounds [9 x <8 x double>], ptr %10, i64 0, i64 %419
  %421 = load <8 x double>, ptr %420, align 64
  %422 = getelementptr inbounds [9 x <8 x double>], ptr %284, i64 0, i64 %419
  store <8 x double> %421, ptr %422, align 64
  %423 = add nuw nsw i64 %404, 1
  %424 = icmp eq i64 %423, 3
  br i1 %424, label %425, label %403

425:
  call void @llvm.lifetime.end.p0(i64 576, ptr nonnull %10)
  %426 = icmp eq i64 %272, %46
  br i1 %426, label %427, label %215

427:
  %428 = fmul contract <8 x double> %1282, zeroinitializer
  br label %429

429:
  %430 = phi <8 x i64> [ %752, %751 ], [ zeroinitializer, %427 ]
  %431 = phi i64 [ %753, %751 ], [ 1, %427 ]
  %432 = getelementptr inbounds %struct.Sphere.5, ptr %165, i64 %431
  %433 = getelementptr inbounds i8, ptr %432, i64 24
  %434 = load double, ptr %433, align 8
  %435 = fcmp contract olt double %434, 0.000000e+00
  br i1 %435, label %751, label %436

436:
  %437 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %431
  %438 = load double, ptr %432, align 8
  %439 = getelementptr inbounds i8, ptr %432, i64 8
  %440 = load double, ptr %439, align 8
  %441 = getelementptr inbounds i8, ptr %432, i64 16
  %442 = load double, ptr %441, align 8
  %443 = getelementptr inbounds i8, ptr %437, i64 576
  %444 = load <8 x double>, ptr %443, align 64
  %445 = load <8 x double>, ptr %437, align 64
  %446 = insertelement <8 x double> poison, double %438, i64 0
  %447 = shufflevector <8 x double> %446, <8 x double> poison, <8 x i32> zeroinitializer
  %448 = fmul contract <8 x double> %447, %445
  %449 = fadd contract <8 x double> %444, %448
  %450 = getelementptr inbounds i8, ptr %437, i64 64
  %451 = load <8 x double>, ptr %450, align 64
  %452 = insertelement <8 x double> poison, double %440, i64 0
  %453 = shufflevector <8 x double> %452, <8 x double> poison, <8 x i32> zeroinitializer
  %454 = fmul contract <8 x double> %453, %451
  %455 = fadd contract <8 x double> %449, %454
  %456 = getelementptr inbounds i8, ptr %437, i64 128
  %457 = load <8 x double>, ptr %456, align 64
  %458 = insertelement <8 x double> poison, double %442, i64 0
  %459 = shufflevector <8 x double> %458, <8 x double> poison, <8 x i32> zeroinitializer
  %460 = fmul contract <8 x double> %459, %457
  %461 = fadd contract <8 x double> %455, %460
  %462 = getelementptr inbounds i8, ptr %437, i64 640
  %463 = load <8 x double>, ptr %462, align 64
  %464 = getelementptr inbounds i8, ptr %437, i64 192
  %465 = load <8 x double>, ptr %464, align 64
  %466 = fmul contract <8 x double> %447, %465
  %467 = fadd contract <8 x double> %463, %466
  %468 = getelementptr inbounds i8, ptr %437, i64 256
  %469 = load <8 x double>, ptr %468, align 64
  %470 = fmul contract <8 x double> %453, %469
  %471 = fadd contract <8 x double> %467, %470
  %472 = getelementptr inbounds i8, ptr %437, i64 320
  %473 = load <8 x double>, ptr %472, align 64
  %474 = fmul contract <8 x double> %459, %473
  %475 = fadd contract <8 x double> %471, %474
  %476 = getelementptr inbounds i8, ptr %437, i64 704
  %477 = load <8 x double>, ptr %476, align 64
  %478 = getelementptr inbounds i8, ptr %437, i64 384
  %479 = load <8 x double>, ptr %478, align 64
  %480 = fmul contract <8 x double> %447, %479
  %481 = fadd contract <8 x double> %477, %480
  %482 = getelementptr inbounds i8, ptr %437, i64 448
  %483 = load <8 x double>, ptr %482, align 64
  %484 = fmul contract <8 x double> %453, %483
  %485 = fadd contract <8 x double> %481, %484
  %486 = getelementptr inbounds i8, ptr %437, i64 512
  %487 = load <8 x double>, ptr %486, align 64
  %488 = fmul contract <8 x double> %459, %487
  %489 = fadd contract <8 x double> %485, %488
  %490 = getelementptr inbounds [17 x double], ptr %11, i64 0, i64 %431
  %491 = load double, ptr %490, align 8
  %492 = insertelement <8 x double> poison, double %491, i64 0
  %493 = shufflevector <8 x double> %492, <8 x double> poison, <8 x i32> zeroinitializer
  %494 = fmul contract <8 x double> %1282, %493
  %495 = getelementptr inbounds [17 x double], ptr %19, i64 0, i64 %431
  %496 = load double, ptr %495, align 8
  %497 = insertelement <8 x double> poison, double %496, i64 0
  %498 = shufflevector <8 x double> %497, <8 x double> poison, <8 x i32> zeroinitializer
  %499 = fadd contract <8 x double> %494, %498
  br i1 %167, label %500, label %751

500:
  %501 = mul nuw nsw i64 %431, %166
  %502 = getelementptr double, ptr %169, i64 %501
  %503 = getelementptr inbounds i64, ptr %170, i64 %431
  %504 = getelementptr inbounds i8, ptr %503, i64 8
  br label %505

505:
  %506 = phi <8 x i64> [ %430, %500 ], [ %748, %747 ]
  %507 = phi i64 [ 0, %500 ], [ %749, %747 ]
  %508 = getelementptr inbounds %struct.Object.6, ptr %168, i64 %507
  %509 = getelementptr double, ptr %502, i64 %507
  %510 = load double, ptr %509, align 8
  %511 = getelementptr inbounds i8, ptr %508, i64 120
  %512 = load double, ptr %511, align 8
  %513 = fadd contract double %510, %512
  %514 = fcmp contract olt double %513, -1.000000e+08
  br i1 %514, label %747, label %515

515:
  %516 = fadd contract double %434, %513
  %517 = insertelement <8 x double> poison, double %516, i64 0
  %518 = shufflevector <8 x double> %517, <8 x double> poison, <8 x i32> zeroinitializer
  %519 = fadd contract <8 x double> %499, %518
  %520 = fcmp contract ogt <8 x double> %519, %428
  %521 = select contract <8 x i1> %520, <8 x double> %519, <8 x double> %428
  %522 = getelementptr inbounds i8, ptr %508, i64 72
  %523 = load double, ptr %522, align 8
  %524 = insertelement <8 x double> poison, double %523, i64 0
  %525 = shufflevector <8 x double> %524, <8 x double> poison, <8 x i32> zeroinitializer
  %526 = load double, ptr %508, align 8
  %527 = insertelement <8 x double> poison, double %526, i64 0
  %528 = shufflevector <8 x double> %527, <8 x double> poison, <8 x i32> zeroinitializer
  %529 = fmul contract <8 x double> %461, %528
  %530 = fadd contract <8 x double> %525, %529
  %531 = getelementptr inbounds i8, ptr %508, i64 8
  %532 = load double, ptr %531, align 8
  %533 = insertelement <8 x double> poison, double %532, i64 0
  %534 = shufflevector <8 x double> %533, <8 x double> poison, <8 x i32> zeroinitializer
  %535 = fmul contract <8 x double> %475, %534
  %536 = fadd contract <8 x double> %530, %535
  %537 = getelementptr inbounds i8, ptr %508, i64 16
  %538 = load double, ptr %537, align 8
  %539 = insertelement <8 x double> poison, double %538, i64 0
  %540 = shufflevector <8 x double> %539, <8 x double> poison, <8 x i32> zeroinitializer
  %541 = fmul contract <8 x double> %489, %540
  %542 = fadd contract <8 x double> %536, %541
  %543 = getelementptr inbounds i8, ptr %508, i64 80
  %544 = load double, ptr %543, align 8
  %545 = insertelement <8 x double> poison, double %544, i64 0
  %546 = shufflevector <8 x double> %545, <8 x double> poison, <8 x i32> zeroinitializer
  %547 = getelementptr inbounds i8, ptr %508, i64 24
  %548 = load double, ptr %547, align 8
  %549 = insertelement <8 x double> poison, double %548, i64 0
  %550 = shufflevector <8 x double> %549, <8 x double> poison, <8 x i32> zeroinitializer
  %551 = fmul contract <8 x double> %461, %550
  %552 = fadd contract <8 x double> %546, %551
  %553 = getelementptr inbounds i8, ptr %508, i64 32
  %554 = load double, ptr %553, align 8
  %555 = insertelement <8 x double> poison, double %554, i64 0
  %556 = shufflevector <8 x double> %555, <8 x double> poison, <8 x i32> zeroinitializer
  %557 = fmul contract <8 x double> %475, %556
  %558 = fadd contract <8 x double> %552, %557
  %559 = getelementptr inbounds i8, ptr %508, i64 40
  %560 = load double, ptr %559, align 8
  %561 = insertelement <8 x double> poison, double %560, i64 0
  %562 = shufflevector <8 x double> %561, <8 x double> poison, <8 x i32> zeroinitializer
  %563 = fmul contract <8 x double> %489, %562
  %564 = fadd contract <8 x double> %558, %563
  %565 = getelementptr inbounds i8, ptr %508, i64 88
  %566 = load double, ptr %565, align 8
  %567 = insertelement <8 x double> poison, double %566, i64 0
  %568 = shufflevector <8 x double> %567, <8 x double> poison, <8 x i32> zeroinitializer
  %569 = getelementptr inbounds i8, ptr %508, i64 48
  %570 = load double, ptr %569, align 8
  %571 = insertelement <8 x double> poison, double %570, i64 0
  %572 = shufflevector <8 x double> %571, <8 x double> poison, <8 x i32> zeroinitializer
  %573 = fmul contract <8 x double> %461, %572
  %574 = fadd contract <8 x double> %568, %573
  %575 = getelementptr inbounds i8, ptr %508, i64 56
  %576 = load double, ptr %575, align 8
  %577 = insertelement <8 x double> poison, double %576, i64 0
  %578 = shufflevector <8 x double> %577, <8 x double> poison, <8 x i32> zeroinitializer
  %579 = fmul contract <8 x double> %475, %578
  %580 = fadd contract <8 x double> %574, %579
  %581 = getelementptr inbounds i8, ptr %508, i64 64
  %582 = load double, ptr %581, align 8
  %583 = insertelement <8 x double> poison, double %582, i64 0
  %584 = shufflevector <8 x double> %583, <8 x double> poison, <8 x i32> zeroinitializer
  %585 = fmul contract <8 x double> %489, %584
  %586 = fadd contract <8 x double> %580, %585
  %587 = fmul contract <8 x double> %542, zeroinitializer
  %588 = getelementptr inbounds i8, ptr %508, i64 136
  %589 = load double, ptr %588, align 8
  %590 = fcmp contract une double %589, 0.000000e+00
  %591 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %586)
  %592 = select contract i1 %590, <8 x double> %586, <8 x double> %591
  %593 = getelementptr inbounds i8, ptr %508, i64 128
  %594 = load double, ptr %593, align 8
  %595 = fcmp contract une double %594, 0.000000e+00
  br i1 %595, label %596, label %601

596:
  %597 = fmul contract <8 x double> %542, %542
  %598 = fmul contract <8 x double> %564, %564
  %599 = fadd contract <8 x double> %597, %598
  %600 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %599)
  br label %603

601:
  %602 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %542)
  br label %603

603:
  %604 = phi contract <8 x double> [ %600, %596 ], [ %602, %601 ]
  %605 = getelementptr inbounds i8, ptr %508, i64 96
  %606 = load double, ptr %605, align 8
  %607 = insertelement <8 x double> poison, double %606, i64 0
  %608 = shufflevector <8 x double> %607, <8 x double> poison, <8 x i32> zeroinitializer
  %609 = fsub contract <8 x double> %604, %608
  %610 = fcmp contract ogt <8 x double> %609, %587
  %611 = select contract <8 x i1> %610, <8 x double> %609, <8 x double> %587
  %612 = getelementptr inbounds i8, ptr %508, i64 112
  %613 = load double, ptr %612, align 8
  %614 = insertelement <8 x double> poison, double %613, i64 0
  %615 = shufflevector <8 x double> %614, <8 x double> poison, <8 x i32> zeroinitializer
  %616 = fsub contract <8 x double> %592, %615
  %617 = fcmp contract ogt <8 x double> %616, %587
  %618 = select contract <8 x i1> %617, <8 x double> %616, <8 x double> %587
  %619 = fmul contract <8 x double> %611, %611
  %620 = fmul contract <8 x double> %618, %618
  %621 = fadd contract <8 x double> %619, %620
  br i1 %595, label %633, label %622

622:
  %623 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %564)
  %624 = getelementptr inbounds i8, ptr %508, i64 104
  %625 = load double, ptr %624, align 8
  %626 = insertelement <8 x double> poison, double %625, i64 0
  %627 = shufflevector <8 x double> %626, <8 x double> poison, <8 x i32> zeroinitializer
  %628 = fsub contract <8 x double> %623, %627
  %629 = fcmp contract ogt <8 x double> %628, %587
  %630 = select contract <8 x i1> %629, <8 x double> %628, <8 x double> %587
  %631 = fmul contract <8 x double> %630, %630
  %632 = fadd contract <8 x double> %621, %631
  br label %633

633:
  %634 = phi <8 x double> [ %632, %622 ], [ %621, %603 ]
  %635 = fmul contract <8 x double> %521, %521
  %636 = fcmp contract olt <8 x double> %634, %635
  %637 = bitcast <8 x i1> %636 to i8
  %638 = icmp eq i8 %637, 0
  br i1 %638, label %747, label %639

639:
  %640 = load i64, ptr %503, align 8
  %641 = load i64, ptr %504, align 8
  %642 = icmp slt i64 %640, %641
  br i1 %642, label %643, label %645

643:
  %644 = getelementptr inbounds i8, ptr %508, i64 104
  br label %650

645:
  %646 = phi <8 x i64> [ %506, %639 ], [ %744, %740 ]
  %647 = icmp eq <8 x i64> %646, zeroinitializer
  %648 = bitcast <8 x i1> %647 to i8
  %649 = icmp eq i8 %648, 0
  br i1 %649, label %1265, label %747

650:
  %651 = phi <8 x i64> [ %506, %643 ], [ %744, %740 ]
  %652 = phi i64 [ %640, %643 ], [ %745, %740 ]
  %653 = getelementptr inbounds %struct.Sphere.5, ptr %171, i64 %652
  %654 = getelementptr inbounds i8, ptr %653, i64 24
  %655 = load double, ptr %654, align 8
  %656 = fadd contract double %513, %655
  %657 = insertelement <8 x double> poison, double %656, i64 0
  %658 = shufflevector <8 x double> %657, <8 x double> poison, <8 x i32> zeroinitializer
  %659 = fadd contract <8 x double> %499, %658
  %660 = fcmp contract ogt <8 x double> %659, %428
  %661 = select contract <8 x i1> %660, <8 x double> %659, <8 x double> %428
  %662 = load double, ptr %653, align 8
  %663 = getelementptr inbounds i8, ptr %653, i64 8
  %664 = load double, ptr %663, align 8
  %665 = getelementptr inbounds i8, ptr %653, i64 16
  %666 = load double, ptr %665, align 8
  %667 = insertelement <8 x double> poison, double %662, i64 0
  %668 = shufflevector <8 x double> %667, <8 x double> poison, <8 x i32> zeroinitializer
  %669 = fmul contract <8 x double> %445, %668
  %670 = fadd contract <8 x double> %444, %669
  %671 = insertelement <8 x double> poison, double %664, i64 0
  %672 = shufflevector <8 x double> %671, <8 x double> poison, <8 x i32> zeroinitializer
  %673 = fmul contract <8 x double> %451, %672
  %674 = fadd contract <8 x double> %670, %673
  %675 = insertelement <8 x double> poison, double %666, i64 0
  %676 = shufflevector <8 x double> %675, <8 x double> poison, <8 x i32> zeroinitializer
  %677 = fmul contract <8 x double> %457, %676
  %678 = fadd contract <8 x double> %674, %677
  %679 = fmul contract <8 x double> %465, %668
  %680 = fadd contract <8 x double> %463, %679
  %681 = fmul contract <8 x double> %469, %672
  %682 = fadd contract <8 x double> %680, %681
  %683 = fmul contract <8 x double> %473, %676
  %684 = fadd contract <8 x double> %682, %683
  %685 = fmul contract <8 x double> %479, %668
  %686 = fadd contract <8 x double> %477, %685
  %687 = fmul contract <8 x double> %483, %672
  %688 = fadd contract <8 x double> %686, %687
  %689 = fmul contract <8 x double> %487, %676
  %690 = fadd contract <8 x double> %688, %689
  %691 = fmul contract <8 x double> %528, %678
  %692 = fadd contract <8 x double> %525, %691
  %693 = fmul contract <8 x double> %534, %684
  %694 = fadd contract <8 x double> %693, %692
  %695 = fmul contract <8 x double> %540, %690
  %696 = fadd contract <8 x double> %695, %694
  %697 = fmul contract <8 x double> %550, %678
  %698 = fadd contract <8 x double> %546, %697
  %699 = fmul contract <8 x double> %556, %684
  %700 = fadd contract <8 x double> %699, %698
  %701 = fmul contract <8 x double> %562, %690
  %702 = fadd contract <8 x double> %701, %700
  %703 = fmul contract <8 x double> %572, %678
  %704 = fadd contract <8 x double> %568, %703
  %705 = fmul contract <8 x double> %578, %684
  %706 = fadd contract <8 x double> %705, %704
  %707 = fmul contract <8 x double> %584, %690
  %708 = fadd contract <8 x double> %707, %706
  %709 = fmul contract <8 x double> %696, zeroinitializer
  %710 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %708)
  %711 = select contract i1 %590, <8 x double> %708, <8 x double> %710
  br i1 %595, label %712, label %717

712:
  %713 = fmul contract <8 x double> %696, %696
  %714 = fmul contract <8 x double> %702, %702
  %715 = fadd contract <8 x double> %713, %714
  %716 = tail call contract noundef <8 x double> @llvm.sqrt.v8f64(<8 x double> %715)
  br label %719

717:
  %718 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %696)
  br label %719

719:
  %720 = phi contract <8 x double> [ %716, %712 ], [ %718, %717 ]
  %721 = fsub contract <8 x double> %720, %608
  %722 = fcmp contract ogt <8 x double> %721, %709
  %723 = select contract <8 x i1> %722, <8 x double> %721, <8 x double> %709
  %724 = fsub contract <8 x double> %711, %615
  %725 = fcmp contract ogt <8 x double> %724, %709
  %726 = select contract <8 x i1> %725, <8 x double> %724, <8 x double> %709
  %727 = fmul contract <8 x double> %723, %723
  %728 = fmul contract <8 x double> %726, %726
  %729 = fadd contract <8 x double> %728, %727
  br i1 %595, label %740, label %730

730:
  %731 = tail call contract <8 x double> @llvm.fabs.v8f64(<8 x double> %702)
  %732 = load double, ptr %644, align 8
  %733 = insertelement <8 x double> poison, double %732, i64 0
  %734 = shufflevector <8 x double> %733, <8 x double> poison, <8 x i32> zeroinitializer
  %735 = fsub contract <8 x double> %731, %734
  %736 = fcmp contract ogt <8 x double> %735, %709
  %737 = select contract <8 x i1> %736, <8 x double> %735, <8 x double> %709
  %738 = fmul contract <8 x double> %737, %737
  %739 = fadd contract <8 x double> %729, %738
  br label %740

740:
  %741 = phi <8 x double> [ %739, %730 ], [ %729, %719 ]
  %742 = fmul contract <8 x double> %661, %661
  %743 = fcmp contract olt <8 x double> %741, %742
  %744 = select <8 x i1> %743, <8 x i64> <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>, <8 x i64> %651
  %745 = add nsw i64 %652, 1
  %746 = icmp eq i64 %745, %641
  br i1 %746, label %645, label %650

747:
  %748 = phi <8 x i64> [ %646, %645 ], [ %506, %633 ], [ %506, %505 ]
  %749 = add nuw nsw i64 %507, 1
  %750 = icmp eq i64 %749, %166
  br i1 %750, label %751, label %505

751:
  %752 = phi <8 x i64> [ %430, %429 ], [ %430, %436 ], [ %748, %747 ]
  %753 = add nuw i64 %431, 1
  %754 = icmp eq i64 %431, %46
  br i1 %754, label %755, label %429

755:
  %756 = phi <8 x double> [ %209, %208 ], [ %428, %751 ]
  %757 = phi <8 x i64> [ zeroinitializer, %208 ], [ %752, %751 ]
  call void @llvm.lifetime.start.p0(i64 36864, ptr nonnull %8)
  br i1 %53, label %760, label %758

758:
  %759 = phi <8 x i64> [ %757, %755 ], [ %1262, %1260 ]
  call void @llvm.lifetime.end.p0(i64 36864, ptr nonnull %8)
  br label %1265

760:
  %761 = phi <8 x i64> [ %1262, %1260 ], [ %757, %755 ]
  %762 = phi i64 [ %1261, %1260 ], [ 0, %755 ]
  %763 = phi i64 [ %1263, %1260 ], [ 0, %755 ]
  %764 = getelementptr inbounds %struct.LinkPair, ptr %172, i64 %763
  %765 = load i64, ptr %764, align 8
  %766 = getelementptr inbounds %struct.Sphere.5, ptr %173, i64 %765
  %767 = getelementptr inbounds i8, ptr %764, i64 8
  %768 = load i64, ptr %767, align 8
  %769 = getelementptr inbounds %struct.Sphere.5, ptr %173, i64 %768
  %770 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %765
  %771 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %768
  %772 = getelementptr inbounds [136 x double], ptr %22, i64 0, i64 %763
  %773 = load double, ptr %772, align 8
  %774 = insertelement <8 x double> poison, double %773, i64 0
  %775 = shufflevector <8 x double> %774, <8 x double> poison, <8 x i32> zeroinitializer
  %776 = fmul contract <8 x double> %1282, %775
  %777 = getelementptr inbounds [136 x double], ptr %23, i64 0, i64 %763
  %778 = load double, ptr %777, align 8
  %779 = getelementptr inbounds double, ptr %174, i64 %763
  %780 = load double, ptr %779, align 8
  %781 = fadd contract double %778, %780
  %782 = insertelement <8 x double> poison, double %781, i64 0
  %783 = shufflevector <8 x double> %782, <8 x double> poison, <8 x i32> zeroinitializer
  %784 = fadd contract <8 x double> %776, %783
  %785 = load double, ptr %769, align 8
  %786 = getelementptr inbounds i8, ptr %769, i64 8
  %787 = load double, ptr %786, align 8
  %788 = getelementptr inbounds i8, ptr %769, i64 16
  %789 = load double, ptr %788, align 8
  %790 = getelementptr inbounds i8, ptr %771, i64 576
  %791 = load <8 x double>, ptr %790, align 64
  %792 = load <8 x double>, ptr %771, align 64
  %793 = insertelement <8 x double> poison, double %785, i64 0
  %794 = shufflevector <8 x double> %793, <8 x double> poison, <8 x i32> zeroinitializer
  %795 = fmul contract <8 x double> %794, %792
  %796 = fadd contract <8 x double> %791, %795
  %797 = getelementptr inbounds i8, ptr %771, i64 64
  %798 = load <8 x double>, ptr %797, align 64
  %799 = insertelement <8 x double> poison, double %787, i64 0
  %800 = shufflevector <8 x double> %799, <8 x double> poison, <8 x i32> zeroinitializer
  %801 = fmul contract <8 x double> %800, %798
  %802 = fadd contract <8 x double> %796, %801
  %803 = getelementptr inbounds i8, ptr %771, i64 128
  %804 = load <8 x double>, ptr %803, align 64
  %805 = insertelement <8 x double> poison, double %789, i64 0
  %806 = shufflevector <8 x double> %805, <8 x double> poison, <8 x i32> zeroinitializer
  %807 = fmul contract <8 x double> %806, %804
  %808 = fadd contract <8 x double> %802, %807
  %809 = getelementptr inbounds i8, ptr %771, i64 640
  %810 = load <8 x double>, ptr %809, align 64
  %811 = getelementptr inbounds i8, ptr %771, i64 192
  %812 = load <8 x double>, ptr %811, align 64
  %813 = fmul contract <8 x double> %794, %812
  %814 = fadd contract <8 x double> %810, %813
  %815 = getelementptr inbounds i8, ptr %771, i64 256
  %816 = load <8 x double>, ptr %815, align 64
  %817 = fmul contract <8 x double> %800, %816
  %818 = fadd contract <8 x double> %814, %817
  %819 = getelementptr inbounds i8, ptr %771, i64 320
  %820 = load <8 x double>, ptr %819, align 64
  %821 = fmul contract <8 x double> %806, %820
  %822 = fadd contract <8 x double> %818, %821
  %823 = getelementptr inbounds i8, ptr %771, i64 704
  %824 = load <8 x double>, ptr %823, align 64
  %825 = getelementptr inbounds i8, ptr %771, i64 384
  %826 = load <8 x double>, ptr %825, align 64
  %827 = fmul contract <8 x double> %794, %826
  %828 = fadd contract <8 x double> %824, %827
  %829 = getelementptr inbounds i8, ptr %771, i64 448
  %830 = load <8 x double>, ptr %829, align 64
  %831 = fmul contract <8 x double> %800, %830
  %832 = fadd contract <8 x double> %828, %831
  %833 = getelementptr inbounds i8, ptr %771, i64 512
  %834 = load <8 x double>, ptr %833, align 64
  %835 = fmul contract <8 x double> %806, %834
  %836 = fadd contract <8 x double> %832, %835
  %837 = getelementptr inbounds i8, ptr %766, i64 24
  %838 = load double, ptr %837, align 8
  %839 = getelementptr inbounds i8, ptr %769, i64 24
  %840 = load double, ptr %839, align 8
  %841 = fadd contract double %838, %840
  %842 = insertelement <8 x double> poison, double %841, i64 0
  %843 = shufflevector <8 x double> %842, <8 x double> poison, <8 x i32> zeroinitializer
  %844 = fadd contract <8 x double> %784, %843
  %845 = fcmp contract ogt <8 x double> %844, %756
  %846 = select contract <8 x i1> %845, <8 x double> %844, <8 x double> %756
  %847 = load double, ptr %766, align 8
  %848 = getelementptr inbounds i8, ptr %766, i64 8
  %849 = load double, ptr %848, align 8
  %850 = getelementptr inbounds i8, ptr %766, i64 16
  %851 = load double, ptr %850, align 8
  %852 = getelementptr inbounds i8, ptr %770, i64 576
  %853 = load <8 x double>, ptr %852, align 64
  %854 = load <8 x double>, ptr %770, align 64
  %855 = insertelement <8 x double> poison, double %847, i64 0
  %856 = shufflevector <8 x double> %855, <8 x double> poison, <8 x i32> zeroinitializer
  %857 = fmul contract <8 x double> %856, %854
  %858 = fadd contract <8 x double> %853, %857
  %859 = getelementptr inbounds i8, ptr %770, i64 64
  %860 = load <8 x double>, ptr %859, align 64
  %861 = insertelement <8 x double> poison, double %849, i64 0
  %862 = shufflevector <8 x double> %861, <8 x double> poison, <8 x i32> zeroinitializer
  %863 = fmul contract <8 x double> %862, %860
  %864 = fadd contract <8 x double> %858, %863
  %865 = getelementptr inbounds i8, ptr %770, i64 128
  %866 = load <8 x double>, ptr %865, align 64
  %867 = insertelement <8 x double> poison, double %851, i64 0
  %868 = shufflevector <8 x double> %867, <8 x double> poison, <8 x i32> zeroinitializer
  %869 = fmul contract <8 x double> %868, %866
  %870 = fadd contract <8 x double> %864, %869
  %871 = getelementptr inbounds i8, ptr %770, i64 640
  %872 = load <8 x double>, ptr %871, align 64
  %873 = getelementptr inbounds i8, ptr %770, i64 192
  %874 = load <8 x double>, ptr %873, align 64
  %875 = fmul contract <8 x double> %856, %874
  %876 = fadd contract <8 x double> %872, %875
  %877 = getelementptr inbounds i8, ptr %770, i64 256
  %878 = load <8 x double>, ptr %877, align 64
  %879 = fmul contract <8 x double> %862, %878
  %880 = fadd contract <8 x double> %876, %879
  %881 = getelementptr inbounds i8, ptr %770, i64 320
  %882 = load <8 x double>, ptr %881, align 64
  %883 = fmul contract <8 x double> %868, %882
  %884 = fadd contract <8 x double> %880, %883
  %885 = getelementptr inbounds i8, ptr %770, i64 704
  %886 = load <8 x double>, ptr %885, align 64
  %887 = getelementptr inbounds i8, ptr %770, i64 384
  %888 = load <8 x double>, ptr %887, align 64
  %889 = fmul contract <8 x double> %856, %888
  %890 = fadd contract <8 x double> %886, %889
  %891 = getelementptr inbounds i8, ptr %770, i64 448
  %892 = load <8 x double>, ptr %891, align 64
  %893 = fmul contract <8 x double> %862, %892
  %894 = fadd contract <8 x double> %890, %893
  %895 = getelementptr inbounds i8, ptr %770, i64 512
  %896 = load <8 x double>, ptr %895, align 64
  %897 = fmul contract <8 x double> %868, %896
  %898 = fadd contract <8 x double> %894, %897
  %899 = fsub contract <8 x double> %870, %808
  %900 = fsub contract <8 x double> %884, %822
  %901 = fsub contract <8 x double> %898, %836
  %902 = fmul contract <8 x double> %899, %899
  %903 = fmul contract <8 x double> %900, %900
  %904 = fadd contract <8 x double> %902, %903
  %905 = fmul contract <8 x double> %901, %901
  %906 = fadd contract <8 x double> %904, %905
  %907 = fmul contract <8 x double> %846, %846
  %908 = fcmp contract olt <8 x double> %906, %907
  %909 = bitcast <8 x i1> %908 to i8
  %910 = icmp eq i8 %909, 0
  br i1 %910, label %1260, label %911

911:
  call void @llvm.lifetime.start.p0(i64 16, ptr nonnull %9)
  store i64 %765, ptr %9, align 16
  store i64 %768, ptr %35, align 8
  br label %918

912:
  %913 = getelementptr inbounds i8, ptr %764, i64 16
  %914 = load i64, ptr %913, align 8
  %915 = getelementptr inbounds i8, ptr %764, i64 24
  %916 = load i64, ptr %915, align 8
  %917 = icmp slt i64 %914, %916
  br i1 %917, label %1001, label %999

918:
  %919 = phi i64 [ %762, %911 ], [ %996, %995 ]
  %920 = phi i64 [ 0, %911 ], [ %997, %995 ]
  %921 = getelementptr inbounds i8, ptr %9, i64 %920
  %922 = load i64, ptr %921, align 8
  %923 = shl nuw i64 1, %922
  %924 = and i64 %923, %919
  %925 = icmp eq i64 %924, 0
  br i1 %925, label %926, label %995

926:
  %927 = or i64 %923, %919
  %928 = getelementptr inbounds i64, ptr %175, i64 %922
  %929 = load i64, ptr %928, align 8
  %930 = getelementptr i8, ptr %928, i64 8
  %931 = load i64, ptr %930, align 8
  %932 = icmp slt i64 %929, %931
  br i1 %932, label %933, label %995

933:
  %934 = getelementptr inbounds %struct.Frame.2, ptr %13, i64 %922
  %935 = getelementptr inbounds i8, ptr %934, i64 576
  %936 = load <8 x double>, ptr %935, align 64
  %937 = load <8 x double>, ptr %934, align 64
  %938 = getelementptr inbounds i8, ptr %934, i64 64
  %939 = load <8 x double>, ptr %938, align 64
  %940 = getelementptr inbounds i8, ptr %934, i64 128
  %941 = load <8 x double>, ptr %940, align 64
  %942 = getelementptr inbounds i8, ptr %934, i64 640
  %943 = load <8 x double>, ptr %942, align 64
  %944 = getelementptr inbounds i8, ptr %934, i64 192
  %945 = load <8 x double>, ptr %944, align 64
  %946 = getelementptr inbounds i8, ptr %934, i64 256
  %947 = load <8 x double>, ptr %946, align 64
  %948 = getelementptr inbounds i8, ptr %934, i64 320
  %949 = load <8 x double>, ptr %948, align 64
  %950 = getelementptr inbounds i8, ptr %934, i64 704
  %951 = load <8 x double>, ptr %950, align 64
  %952 = getelementptr inbounds i8, ptr %934, i64 384
  %953 = load <8 x double>, ptr %952, align 64
  %954 = getelementptr inbounds i8, ptr %934, i64 448
  %955 = load <8 x double>, ptr %954, align 64
  %956 = getelementptr inbounds i8, ptr %934, i64 512
  %957 = load <8 x double>, ptr %956, align 64
  br label %958

958:
  %959 = phi i64 [ %929, %933 ], [ %993, %958 ]
  %960 = getelementptr inbounds %struct.Part.7, ptr %176, i64 %959
  %961 = load double, ptr %960, align 8
  %962 = getelementptr inbounds i8, ptr %960, i64 8
  %963 = load double, ptr %962, align 8
  %964 = getelementptr inbounds i8, ptr %960, i64 16
  %965 = load double, ptr %964, align 8
  %966 = insertelement <8 x double> poison, double %961, i64 0
  %967 = shufflevector <8 x double> %966, <8 x double> poison, <8 x i32> zeroinitializer
  %968 = fmul contract <8 x double> %937, %967
  %969 = fadd contract <8 x double> %936, %968
  %970 = insertelement <8 x double> poison, double %963, i64 0
  %971 = shufflevector <8 x double> %970, <8 x double> poison, <8 x i32> zeroinitializer
  %972 = fmul contract <8 x double> %939, %971
  %973 = fadd contract <8 x double> %969, %972
  %974 = insertelement <8 x double> poison, double %965, i64 0
  %975 = shufflevector <8 x double> %974, <8 x double> poison, <8 x i32> zeroinitializer
  %976 = fmul contract <8 x double> %941, %975
  %977 = fadd contract <8 x double> %973, %976
  %978 = fmul contract <8 x double> %945, %967
  %979 = fadd contract <8 x double> %943, %978
  %980 = fmul contract <8 x double> %947, %971
  %981 = fadd contract <8 x double> %979, %980
  %982 = fmul contract <8 x double> %949, %975
  %983 = fadd contract <8 x double> %981, %982
  %984 = fmul contract <8 x double> %953, %967
  %985 = fadd contract <8 x double> %951, %984
  %986 = fmul contract <8 x double> %955, %971
  %987 = fadd contract <8 x double> %985, %986
  %988 = fmul contract <8 x double> %957, %975
  %989 = fadd contract <8 x double> %987, %988
  %990 = getelementptr inbounds [192 x %struct.Point.4], ptr %8, i64 0, i64 %959
  store <8 x double> %977, ptr %990, align 64
  %991 = getelementptr inbounds i8, ptr %990, i64 64
  store <8 x double> %983, ptr %991, align 64
  %992 = getelementptr inbounds i8, ptr %990, i64 128
  store <8 x double> %989, ptr %992, align 64
  %993 = add nsw i64 %959, 1
  %994 = icmp eq i64 %993, %931
  br i1 %994, label %995, label %958

995:
  %996 = phi i64 [ %919, %918 ], [ %927, %926 ], [ %927, %958 ]
  %997 = add nuw nsw i64 %920, 8
  %998 = icmp eq i64 %997, 16
  br i1 %998, label %912, label %918

999:
  %1000 = phi <8 x i64> [ %761, %912 ], [ %1257, %1254 ]
  call void @llvm.lifetime.end.p0(i64 16, ptr nonnull %9)
  br label %1260

1001:
  %1002 = phi <8 x i64> [ %1257, %1254 ], [ %761, %912 ]
  %1003 = phi i64 [ %1258, %1254 ], [ %914, %912 ]
  %1004 = phi i1 [ %1255, %1254 ], [ false, %912 ]
  %1005 = phi i64 [ %1256, %1254 ], [ -1, %912 ]
  %1006 = getelementptr inbounds %struct.PartPair, ptr %177, i64 %1003
  %1007 = load i64, ptr %1006, align 8
  %1008 = getelementptr inbounds %struct.Part.7, ptr %176, i64 %1007
  %1009 = getelementptr inbounds i8, ptr %1006, i64 8
  %1010 = load i64, ptr %1009, align 8
  %1011 = getelementptr inbounds %struct.Part.7, ptr %176, i64 %1010
  %1012 = icmp eq i64 %1007, %1005
  br i1 %1012, label %1040, label %1013

1013:
  %1014 = getelementptr inbounds i8, ptr %1008, i64 56
  %1015 = load double, ptr %1014, align 8
  %1016 = fadd contract double %840, %1015
  %1017 = insertelement <8 x double> poison, double %1016, i64 0
  %1018 = shufflevector <8 x double> %1017, <8 x double> poison, <8 x i32> zeroinitializer
  %1019 = fadd contract <8 x double> %784, %1018
  %1020 = fcmp contract ogt <8 x double> %1019, %756
  %1021 = select contract <8 x i1> %1020, <8 x double> %1019, <8 x double> %756
  %1022 = getelementptr inbounds [192 x %struct.Point.4], ptr %8, i64 0, i64 %1007
  %1023 = load <8 x double>, ptr %1022, align 64
  %1024 = fsub contract <8 x double> %1023, %808
  %1025 = getelementptr inbounds i8, ptr %1022, i64 64
  %1026 = load <8 x double>, ptr %1025, align 64
  %1027 = fsub contract <8 x double> %1026, %822
  %1028 = getelementptr inbounds i8, ptr %1022, i64 128
  %1029 = load <8 x double>, ptr %1028, align 64
  %1030 = fsub contract <8 x double> %1029, %836
  %1031 = fmul contract <8 x double> %1024, %1024
  %1032 = fmul contract <8 x double> %1027, %1027
  %1033 = fadd contract <8 x double> %1031, %1032
  %1034 = fmul contract <8 x double> %1030, %1030
  %1035 = fadd contract <8 x double> %1033, %1034
  %1036 = fmul contract <8 x double> %1021, %1021
  %1037 = fcmp contract olt <8 x double> %1035, %1036
  %1038 = bitcast <8 x i1> %1037 to i8
  %1039 = icmp eq i8 %1038, 0
  br i1 %1039, label %1254, label %1050

1040:
  br i1 %1004, label %1041, label %1254

1041:
  %1042 = getelementptr inbounds i8, ptr %1008, i64 56
  %1043 = load double, ptr %1042, align 8
  %1044 = getelementptr inbounds [192 x %struct.Point.4], ptr %8, i64 0, i64 %1005
  %1045 = load <8 x double>, ptr %1044, align 64
  %1046 = getelementptr inbounds i8, ptr %1044, i64 64
  %1047 = load <8 x double>, ptr %1046, align 64
  %1048 = getelementptr inbounds i8, ptr %1044, i64 128
  %1049 = load <8 x double>, ptr %1048, align 64
  br label %1050

1050:
  %1051 = phi <8 x double> [ %1029, %1013 ], [ %1049, %1041 ]
  %1052 = phi <8 x double> [ %1026, %1013 ], [ %1047, %1041 ]
  %1053 = phi <8 x double> [ %1023, %1013 ], [ %1045, %1041 ]
  %1054 = phi double [ %1015, %1013 ], [ %1043, %1041 ]
  %1055 = phi i64 [ %1007, %1013 ], [ %1005, %1041 ]
  %1056 = getelementptr inbounds i8, ptr %1011, i64 56
  %1057 = load double, ptr %1056, align 8
  %1058 = fadd contract double %1054, %1057
  %1059 = insertelement <8 x double> poison, double %1058, i64 0
  %1060 = shufflevector <8 x double> %1059, <8 x double> poison, <8 x i32> zeroinitializer
  %1061 = fadd contract <8 x double> %784, %1060
  %1062 = fcmp contract ogt <8 x double> %1061, %756
  %1063 = select contract <8 x i1> %1062, <8 x double> %1061, <8 x double> %756
  %1064 = getelementptr inbounds [192 x %struct.Point.4], ptr %8, i64 0, i64 %1010
  %1065 = load <8 x double>, ptr %1064, align 64
  %1066 = fsub contract <8 x double> %1053, %1065
  %1067 = getelementptr inbounds i8, ptr %1064, i64 64
  %1068 = load <8 x double>, ptr %1067, align 64
  %1069 = fsub contract <8 x double> %1052, %1068
  %1070 = getelementptr inbounds i8, ptr %1064, i64 128
  %1071 = load <8 x double>, ptr %1070, align 64
  %1072 = fsub contract <8 x double> %1051, %1071
  %1073 = fmul contract <8 x double> %1066, %1066
  %1074 = fmul contract <8 x double> %1069, %1069
  %1075 = fadd contract <8 x double> %1073, %1074
  %1076 = fmul contract <8 x double> %1072, %1072
  %1077 = fadd contract <8 x double> %1075, %1076
  %1078 = fmul contract <8 x double> %1063, %1063
  %1079 = fcmp contract olt <8 x double> %1077, %1078
  %1080 = bitcast <8 x i1> %1079 to i8
  %1081 = icmp eq i8 %1080, 0
  br i1 %1081, label %1254, label %1082

1082:
  %1083 = getelementptr inbounds i8, ptr %1008, i64 48
  %1084 = load double, ptr %1083, align 8
  %1085 = getelementptr inbounds i8, ptr %1011, i64 48
  %1086 = load double, ptr %1085, align 8
  %1087 = fadd contract double %1084, %1086
  %1088 = insertelement <8 x double> poison, double %1087, i64 0
  %1089 = shufflevector <8 x double> %1088, <8 x double> poison, <8 x i32> zeroinitializer
  %1090 = fadd contract <8 x double> %784, %1089
  %1091 = fcmp contract ogt <8 x double> %1090, %756
  %1092 = select contract <8 x i1> %1091, <8 x double> %1090, <8 x double> %756
  %1093 = getelementptr inbounds i8, ptr %1008, i64 24
  %1094 = load double, ptr %1093, align 8
  %1095 = fmul contract double %1094, %1094
  %1096 = getelementptr inbounds i8, ptr %1008, i64 32
  %1097 = load double, ptr %1096, align 8
  %1098 = fmul contract double %1097, %1097
  %1099 = fadd contract double %1095, %1098
  %1100 = getelementptr inbounds i8, ptr %1008, i64 40
  %1101 = load double, ptr %1100, align 8
  %1102 = fmul contract double %1101, %1101
  %1103 = fadd contract double %1099, %1102
  %1104 = getelementptr inbounds i8, ptr %1011, i64 24
  %1105 = load double, ptr %1104, align 8
  %1106 = fmul contract double %1105, %1105
  %1107 = getelementptr inbounds i8, ptr %1011, i64 32
  %1108 = load double, ptr %1107, align 8
  %1109 = fmul contract double %1108, %1108
  %1110 = fadd contract double %1106, %1109
  %1111 = getelementptr inbounds i8, ptr %1011, i64 40
  %1112 = load double, ptr %1111, align 8
  %1113 = fmul contract double %1112, %1112
  %1114 = fadd contract double %1110, %1113
  %1115 = fcmp contract oeq double %1103, 0.000000e+00
  %1116 = fcmp contract oeq double %1114, 0.000000e+00
  %1117 = select i1 %1115, i1 %1116, i1 false
  br i1 %1117, label %1249, label %1118

1118:
  %1119 = fmul contract <8 x double> %1053, zeroinitializer
  %1120 = fadd contract <8 x double> %1119, <double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01, double 5.000000e-01>
  %1121 = insertelement <8 x double> poison, double %1094, i64 0
  %1122 = shufflevector <8 x double> %1121, <8 x double> poison, <8 x i32> zeroinitializer
  %1123 = fmul contract <8 x double> %854, %1122
  %1124 = insertelement <8 x double> poison, double %1097, i64 0
  %1125 = shufflevector <8 x double> %1124, <8 x double> poison, <8 x i32> zeroinitializer
  %1126 = fmul contract <8 x double> %860, %1125
  %1127 = fadd contract <8 x double> %1123, %1126
  %1128 = insertelement <8 x double> poison, double %1101, i64 0
  %1129 = shufflevector <8 x double> %1128, <8 x double> poison, <8 x i32> zeroinitializer
  %1130 = fmul contract <8 x double> %866, %1129
  %1131 = fadd contract <8 x double> %1127, %1130
  %1132 = fmul contract <8 x double> %874, %1122
  %1133 = fmul contract <8 x double> %878, %1125
  %1134 = fadd contract <8 x double> %1132, %1133
  %1135 = fmul contract <8 x double> %882, %1129
  %1136 = fadd contract <8 x double> %1134, %1135
  %1137 = fmul contract <8 x double> %888, %1122
  %1138 = fmul contract <8 x double> %892, %1125
  %1139 = fadd contract <8 x double> %1137, %1138
  %1140 = fmul contract <8 x double> %896, %1129
  %1141 = fadd contract <8 x double> %1139, %1140
  %1142 = insertelement <8 x double> poison, double %1105, i64 0
  %1143 = shufflevector <8 x double> %1142, <8 x double> poison, <8 x i32> zeroinitializer
  %1144 = fmul contract <8 x double> %792, %1143
  %1145 = insertelement <8 x double> poison, double %1108, i64 0
  %1146 = shufflevector <8 x double> %1145, <8 x double> poison, <8 x i32> zeroinitializer
  %1147 = fmul contract <8 x double> %798, %1146
  %1148 = fadd contract <8 x double> %1144, %1147
  %1149 = insertelement <8 x double> poison, double %1112, i64 0
  %1150 = shufflevector <8 x double> %1149, <8 x double> poison, <8 x i32> zeroinitializer
  %1151 = fmul contract <8 x double> %804, %1150
  %1152 = fadd contract <8 x double> %1148, %1151
  %1153 = fmul contract <8 x double> %812, %1143
  %1154 = fmul contract <8 x double> %816, %1146
  %1155 = fadd contract <8 x double> %1153, %1154
  %1156 = fmul contract <8 x double> %820, %1150
  %1157 = fadd contract <8 x double> %1155, %1156
  %1158 = fmul contract <8 x double> %826, %1143
  %1159 = fmul contract <8 x double> %830, %1146
  %1160 = fadd contract <8 x double> %1158, %1159
  %1161 = fmul contract <8 x double> %834, %1150
  %1162 = fadd contract <8 x double> %1160, %1161
  %1163 = fcmp contract ogt double %1103, 0.000000e+00
  %1164 = fdiv contract double 1.000000e+00, %1103
  %1165 = select contract i1 %1163, double %1164, double 0.000000e+00
  %1166 = fcmp contract ogt double %1114, 0.000000e+00
  %1167 = fdiv contract double 1.000000e+00, %1114
  %1168 = select contract i1 %1166, double %1167, double 0.000000e+00
  %1169 = fmul contract <8 x double> %1131, %1152
  %1170 = fmul contract <8 x double> %1136, %1157
  %1171 = fadd contract <8 x double> %1169, %1170
  %1172 = fmul contract <8 x double> %1141, %1162
  %1173 = fadd contract <8 x double> %1172, %1171
  %1174 = fmul contract <8 x double> %1066, %1131
  %1175 = fmul contract <8 x double> %1069, %1136
  %1176 = fadd contract <8 x double> %1174, %1175
  %1177 = fmul contract <8 x double> %1072, %1141
  %1178 = fadd contract <8 x double> %1177, %1176
  %1179 = fmul contract <8 x double> %1066, %1152
  %1180 = fmul contract <8 x double> %1069, %1157
  %1181 = fadd contract <8 x double> %1179, %1180
  %1182 = fmul contract <8 x double> %1072, %1162
  %1183 = fadd contract <8 x double> %1182, %1181
  %1184 = fmul contract double %1103, %1114
  %1185 = insertelement <8 x double> poison, double %1184, i64 0
  %1186 = shufflevector <8 x double> %1185, <8 x double> poison, <8 x i32> zeroinitializer
  %1187 = fmul contract <8 x double> %1173, %1173
  %1188 = fsub contract <8 x double> %1186, %1187
  %1189 = fmul contract double %1103, 0x3E7AD7F29ABCAF48
  %1190 = fmul contract double %1189, %1114
  %1191 = insertelement <8 x double> poison, double %1190, i64 0
  %1192 = shufflevector <8 x double> %1191, <8 x double> poison, <8 x i32> zeroinitializer
  %1193 = fcmp contract ogt <8 x double> %1188, %1192
  %1194 = fmul contract <8 x double> %1173, %1183
  %1195 = insertelement <8 x double> poison, double %1114, i64 0
  %1196 = shufflevector <8 x double> %1195, <8 x double> poison, <8 x i32> zeroinitializer
  %1197 = fmul contract <8 x double> %1196, %1178
  %1198 = fsub contract <8 x double> %1194, %1197
  %1199 = select contract <8 x i1> %1193, <8 x double> %1188, <8 x double> %1120
  %1200 = fdiv contract <8 x double> %1198, %1199
  %1201 = fneg contract <8 x double> %1120
  %1202 = fcmp contract ogt <8 x double> %1200, %1201
  %1203 = select contract <8 x i1> %1202, <8 x double> %1200, <8 x double> %1201
  %1204 = fcmp contract olt <8 x double> %1203, %1120
  %1205 = select contract <8 x i1> %1204, <8 x double> %1203, <8 x double> %1120
  %1206 = select contract <8 x i1> %1193, <8 x double> %1205, <8 x double> %1201
  %1207 = fmul contract <8 x double> %1173, %1206
  %1208 = fadd contract <8 x double> %1183, %1207
  %1209 = insertelement <8 x double> poison, double %1168, i64 0
  %1210 = shufflevector <8 x double> %1209, <8 x double> poison, <8 x i32> zeroinitializer
  %1211 = fmul contract <8 x double> %1210, %1208
  %1212 = fcmp contract ogt <8 x double> %1211, %1201
  %1213 = select contract <8 x i1> %1212, <8 x double> %1211, <8 x double> %1201
  %1214 = fcmp contract olt <8 x double> %1213, %1120
  %1215 = select contract <8 x i1> %1214, <8 x double> %1213, <8 x double> %1120
  %1216 = fmul contract <8 x double> %1173, %1215
  %1217 = fsub contract <8 x double> %1216, %1178
  %1218 = insertelement <8 x double> poison, double %1165, i64 0
  %1219 = shufflevector <8 x double> %1218, <8 x double> poison, <8 x i32> zeroinitializer
  %1220 = fmul contract <8 x double> %1219, %1217
  %1221 = fcmp contract ogt <8 x double> %1220, %1201
  %1222 = select contract <8 x i1> %1221, <8 x double> %1220, <8 x double> %1201
  %1223 = fcmp contract olt <8 x double> %1222, %1120
  %1224 = select contract <8 x i1> %1223, <8 x double> %1222, <8 x double> %1120
  %1225 = fmul contract <8 x double> %1173, %1224
  %1226 = fadd contract <8 x double> %1183, %1225
  %1227 = fmul contract <8 x double> %1210, %1226
  %1228 = fcmp contract ogt <8 x double> %1227, %1201
  %1229 = select contract <8 x i1> %1228, <8 x double> %1227, <8 x double> %1201
  %1230 = fcmp contract olt <8 x double> %1229, %1120
  %1231 = select contract <8 x i1> %1230, <8 x double> %1229, <8 x double> %1120
  %1232 = fmul contract <8 x double> %1131, %1224
  %1233 = fadd contract <8 x double> %1066, %1232
  %1234 = fmul contract <8 x double> %1152, %1231
  %1235 = fsub contract <8 x double> %1233, %1234
  %1236 = fmul contract <8 x double> %1136, %1224
  %1237 = fadd contract <8 x double> %1069, %1236
  %1238 = fmul contract <8 x double> %1157, %1231
  %1239 = fsub contract <8 x double> %1237, %1238
  %1240 = fmul contract <8 x double> %1141, %1224
  %1241 = fadd contract <8 x double> %1072, %1240
  %1242 = fmul contract <8 x double> %1162, %1231
  %1243 = fsub contract <8 x double> %1241, %1242
  %1244 = fmul contract <8 x double> %1235, %1235
  %1245 = fmul contract <8 x double> %1239, %1239
  %1246 = fadd contract <8 x double> %1244, %1245
  %1247 = fmul contract <8 x double> %1243, %1243
  %1248 = fadd contract <8 x double> %1247, %1246
  br label %1249

1249:
  %1250 = phi <8 x double> [ %1248, %1118 ], [ %1077, %1082 ]
  %1251 = fmul contract <8 x double> %1092, %1092
  %1252 = fcmp contract olt <8 x double> %1250, %1251
  %1253 = select <8 x i1> %1252, <8 x i64> <i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1, i64 -1>, <8 x i64> %1002
  br label %1254

1254:
  %1255 = phi i1 [ true, %1249 ], [ false, %1040 ], [ true, %1050 ], [ false, %1013 ]
  %1256 = phi i64 [ %1055, %1249 ], [ %1005, %1040 ], [ %1055, %1050 ], [ %1007, %1013 ]
  %1257 = phi <8 x i64> [ %1253, %1249 ], [ %1002, %1040 ], [ %1002, %1050 ], [ %1002, %1013 ]
  %1258 = add nsw i64 %1003, 1
  %1259 = icmp eq i64 %1258, %916
  br i1 %1259, label %999, label %1001

1260:
  %1261 = phi i64 [ %996, %999 ], [ %762, %760 ]
  %1262 = phi <8 x i64> [ %1000, %999 ], [ %761, %760 ]
  %1263 = add nuw nsw i64 %763, 1
  %1264 = icmp eq i64 %1263, %52
  br i1 %1264, label %758, label %760

1265:
  %1266 = phi <8 x i64> [ %759, %758 ], [ %646, %645 ]
  %1267 = icmp sgt i64 %189, 0
  br i1 %1267, label %1285, label %1315

1268:
  %1269 = phi <8 x double> [ %190, %188 ], [ %1279, %1268 ]
  %1270 = phi <8 x double> [ %191, %188 ], [ %1282, %1268 ]
  %1271 = phi i64 [ 0, %188 ], [ %1283, %1268 ]
  %1272 = icmp sgt i64 %189, %1271
  %1273 = xor i64 %1271, -1
  %1274 = select i1 %1272, i64 %1273, i64 -1
  %1275 = add i64 %1274, %189
  %1276 = getelementptr inbounds [4096 x %struct.Piece], ptr %12, i64 0, i64 %1275
  %1277 = getelementptr inbounds [8 x %struct.Piece], ptr %14, i64 0, i64 %1271
  call void @llvm.memcpy.p0.p0.i64(ptr noundef nonnull align 16 dereferenceable(16) %1277, ptr noundef nonnull align 16 dereferenceable(16) %1276, i64 16, i1 false)
  %1278 = load double, ptr %1277, align 16
  %1279 = insertelement <8 x double> %1269, double %1278, i64 %1271
  %1280 = getelementptr inbounds i8, ptr %1277, i64 8
  %1281 = load double, ptr %1280, align 8
  %1282 = insertelement <8 x double> %1270, double %1281, i64 %1271
  %1283 = add nuw nsw i64 %1271, 1
  %1284 = icmp eq i64 %1283, 8
  br i1 %1284, label %192, label %1268

1285:
  %1286 = phi i64 [ %1312, %1311 ], [ %207, %1265 ]
  %1287 = phi i64 [ %1313, %1311 ], [ 0, %1265 ]
  %1288 = extractelement <8 x i64> %1266, i64 %1287
  %1289 = icmp eq i64 %1288, 0
  br i1 %1289, label %1311, label %1290

1290:
  %1291 = getelementptr inbounds [8 x %struct.Piece], ptr %14, i64 0, i64 %1287
  %1292 = getelementptr inbounds i8, ptr %1291, i64 8
  %1293 = load double, ptr %1292, align 8
  %1294 = fmul contract double %161, %1293
  %1295 = fmul contract double %1294, 2.000000e+00
  %1296 = fcmp contract olt double %1295, %5
  %1297 = icmp sgt i64 %1286, 4094
  %1298 = select i1 %1296, i1 true, i1 %1297
  br i1 %1298, label %1299, label %1300

1299:
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %14)
  br label %1318

1300:
  %1301 = fmul contract double %1293, 5.000000e-01
  %1302 = load double, ptr %1291, align 16
  %1303 = fsub contract double %1302, %1301
  %1304 = add nsw i64 %1286, 1
  %1305 = getelementptr inbounds [4096 x %struct.Piece], ptr %12, i64 0, i64 %1286
  store double %1303, ptr %1305, align 16
  %1306 = getelementptr inbounds i8, ptr %1305, i64 8
  store double %1301, ptr %1306, align 8
  %1307 = fadd contract double %1301, %1302
  %1308 = add nsw i64 %1286, 2
  %1309 = getelementptr inbounds [4096 x %struct.Piece], ptr %12, i64 0, i64 %1304
  store double %1307, ptr %1309, align 16
  %1310 = getelementptr inbounds i8, ptr %1309, i64 8
  store double %1301, ptr %1310, align 8
  br label %1311

1311:
  %1312 = phi i64 [ %1286, %1285 ], [ %1308, %1300 ]
  %1313 = add nuw nsw i64 %1287, 1
  %1314 = icmp eq i64 %1313, %206
  br i1 %1314, label %1315, label %1285

1315:
  %1316 = phi i64 [ %207, %1265 ], [ %1312, %1311 ]
  call void @llvm.lifetime.end.p0(i64 128, ptr nonnull %14)
  %1317 = icmp eq i64 %1316, 0
  br i1 %1317, label %1318, label %188

1318:
  %1319 = phi i8 [ 0, %1299 ], [ 1, %1315 ]
  call void @llvm.lifetime.end.p0(i64 13056, ptr nonnull %13)
  call void @llvm.lifetime.end.p0(i64 65536, ptr nonnull %12)
  call void @llvm.lifetime.end.p0(i64 2448, ptr nonnull %11)
  %1320 = getelementptr inbounds i8, ptr %6, i64 %41
  store i8 %1319, ptr %1320, align 1
  %1321 = add nuw nsw i64 %41, 1
  %1322 = icmp eq i64 %1321, %4
  br i1 %1322, label %39, label %40
}

define i64 @search_route(ptr nocapture noundef readonly %0, ptr nocapture noundef readonly %1, ptr nocapture noundef readonly %2, ptr nocapture noundef readonly %3, i64 noundef %4, i64 noundef %5, ptr nocapture noundef %6, ptr nocapture noundef writeonly %7) {
  %9 = alloca <16 x float>, align 64
  %10 = alloca <16 x float>, align 64
  %11 = alloca <16 x float>, align 64
  %12 = alloca <16 x float>, align 64
  %13 = alloca [2 x %struct.Tree], align 16
  %14 = alloca %struct.Random, align 8
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %14)
  store i64 %5, ptr %14, align 8
  %15 = load <16 x float>, ptr %2, align 4
  call void @llvm.lifetime.start.p0(i64 48, ptr nonnull %13)
  %16 = getelementptr inbounds i8, ptr %1, i64 64
  %17 = load ptr, ptr %16, align 8
  store ptr %17, ptr %13, align 16
  %18 = getelementptr inbounds i8, ptr %13, i64 8
  %19 = getelementptr inbounds i8, ptr %1, i64 72
  %20 = load ptr, ptr %19, align 8
  store ptr %20, ptr %18, align 8
  %21 = getelementptr inbounds i8, ptr %13, i64 16
  %22 = getelementptr inbounds i8, ptr %13, i64 24
  %23 = getelementptr inbounds i8, ptr %1, i64 40
  %24 = load i64, ptr %23, align 8
  %25 = getelementptr inbounds <16 x float>, ptr %17, i64 %24
  store ptr %25, ptr %22, align 8
  %26 = getelementptr inbounds i8, ptr %13, i64 32
  %27 = getelementptr inbounds i32, ptr %20, i64 %24
  store ptr %27, ptr %26, align 16
  %28 = getelementptr inbounds i8, ptr %13, i64 40
  store i64 0, ptr %28, align 8
  store <16 x float> %15, ptr %17, align 4
  store i64 1, ptr %21, align 16
  store i32 -1, ptr %20, align 4
  %29 = icmp sgt i64 %4, 0
  br i1 %29, label %47, label %31

30:
  store i64 %4, ptr %28, align 8
  br label %31

31:
  %32 = load ptr, ptr %1, align 8
  %33 = load <16 x float>, ptr %32, align 4
  %34 = getelementptr inbounds i8, ptr %1, i64 8
  %35 = load ptr, ptr %34, align 8
  %36 = load <16 x float>, ptr %35, align 4
  %37 = getelementptr inbounds i8, ptr %1, i64 48
  %38 = load i64, ptr %37, align 8
  %39 = icmp sgt i64 %38, 0
  br i1 %39, label %40, label %433

40:
  %41 = getelementptr inbounds i8, ptr %1, i64 24
  %42 = getelementptr inbounds i8, ptr %1, i64 16
  %43 = getelementptr inbounds i8, ptr %1, i64 32
  %44 = getelementptr inbounds i8, ptr %1, i64 80
  %45 = getelementptr inbounds i8, ptr %1, i64 84
  %46 = getelementptr inbounds i8, ptr %1, i64 88
  br label %55

47:
  %48 = phi i64 [ %52, %47 ], [ 0, %8 ]
  %49 = getelementptr inbounds <16 x float>, ptr %3, i64 %48
  %50 = load <16 x float>, ptr %49, align 4
  %51 = getelementptr inbounds <16 x float>, ptr %25, i64 %48
  store <16 x float> %50, ptr %51, align 4
  %52 = add nuw nsw i64 %48, 1
  %53 = getelementptr inbounds i32, ptr %27, i64 %48
  store i32 -1, ptr %53, align 4
  %54 = icmp eq i64 %52, %4
  br i1 %54, label %30, label %47

55:
  %56 = phi i64 [ %38, %40 ], [ %430, %429 ]
  %57 = phi i64 [ %5, %40 ], [ %83, %429 ]
  %58 = phi i64 [ 0, %40 ], [ %431, %429 ]
  %59 = load i64, ptr %21, align 16
  %60 = load i64, ptr %28, align 8
  %61 = icmp sgt i64 %59, %60
  %62 = zext i1 %61 to i64
  %63 = getelementptr inbounds [2 x %struct.Tree], ptr %13, i64 0, i64 %62
  %64 = xor i1 %61, true
  %65 = zext i1 %64 to i64
  %66 = getelementptr inbounds [2 x %struct.Tree], ptr %13, i64 0, i64 %65
  %67 = getelementptr inbounds i8, ptr %63, i64 16
  %68 = load i64, ptr %67, align 8
  %69 = load i64, ptr %23, align 8
  %70 = icmp slt i64 %68, %69
  br i1 %70, label %71, label %433

71:
  %72 = getelementptr inbounds i8, ptr %66, i64 16
  %73 = load i64, ptr %72, align 8
  %74 = icmp slt i64 %73, %69
  br i1 %74, label %75, label %433

75:
  %76 = load i64, ptr %0, align 8
  %77 = icmp sgt i64 %76, 0
  br i1 %77, label %78, label %82

78:
  %79 = mul i64 %76, -7046029254386353131
  br label %185

80:
  %81 = add i64 %79, %57
  br label %82

82:
  %83 = phi i64 [ %57, %75 ], [ %81, %80 ]
  %84 = phi <16 x float> [ %33, %75 ], [ %205, %80 ]
  %85 = load ptr, ptr %63, align 8
  %86 = load ptr, ptr %41, align 8
  %87 = load <16 x float>, ptr %86, align 4
  %88 = fcmp contract oeq <16 x float> %87, zeroinitializer
  %89 = select contract <16 x i1> %88, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %90 = fadd contract <16 x float> %87, %89
  %91 = load ptr, ptr %42, align 8
  %92 = load <16 x float>, ptr %91, align 4
  %93 = icmp sgt i64 %68, 1
  br i1 %93, label %94, label %149

94:
  %95 = load <16 x float>, ptr %85, align 4
  %96 = fsub contract <16 x float> %84, %95
  %97 = fdiv contract <16 x float> %96, %90
  %98 = fadd contract <16 x float> %97, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %99 = fadd contract <16 x float> %98, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %100 = fmul contract <16 x float> %87, %99
  %101 = fsub contract <16 x float> %96, %100
  %102 = fmul contract <16 x float> %92, %101
  %103 = fmul contract <16 x float> %102, %102
  %104 = shufflevector <16 x float> %103, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %105 = shufflevector <16 x float> %103, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %106 = fadd contract <8 x float> %104, %105
  %107 = shufflevector <8 x float> %106, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %108 = shufflevector <8 x float> %106, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %109 = fadd contract <4 x float> %107, %108
  %110 = shufflevector <4 x float> %109, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %111 = fadd contract <4 x float> %109, %110
  %112 = shufflevector <4 x float> %109, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %113 = fadd contract <4 x float> %109, %112
  %114 = shufflevector <4 x float> %113, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %115 = fadd contract <4 x float> %111, %114
  %116 = extractelement <4 x float> %115, i64 0
  br label %117

117:
  %118 = phi i64 [ %146, %117 ], [ 0, %94 ]
  %119 = phi i64 [ %147, %117 ], [ 1, %94 ]
  %120 = phi float [ %145, %117 ], [ %116, %94 ]
  %121 = getelementptr inbounds <16 x float>, ptr %85, i64 %119
  %122 = load <16 x float>, ptr %121, align 4
  %123 = fsub contract <16 x float> %84, %122
  %124 = fdiv contract <16 x float> %123, %90
  %125 = fadd contract <16 x float> %124, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %126 = fadd contract <16 x float> %125, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %127 = fmul contract <16 x float> %87, %126
  %128 = fsub contract <16 x float> %123, %127
  %129 = fmul contract <16 x float> %92, %128
  %130 = fmul contract <16 x float> %129, %129
  %131 = shufflevector <16 x float> %130, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %132 = shufflevector <16 x float> %130, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %133 = fadd contract <8 x float> %131, %132
  %134 = shufflevector <8 x float> %133, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %135 = shufflevector <8 x float> %133, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %136 = fadd contract <4 x float> %134, %135
  %137 = shufflevector <4 x float> %136, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %138 = fadd contract <4 x float> %136, %137
  %139 = shufflevector <4 x float> %136, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %140 = fadd contract <4 x float> %136, %139
  %141 = shufflevector <4 x float> %140, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %142 = fadd contract <4 x float> %138, %141
  %143 = extractelement <4 x float> %142, i64 0
  %144 = fcmp contract olt float %143, %120
  %145 = select i1 %144, float %143, float %120
  %146 = select i1 %144, i64 %119, i64 %118
  %147 = add nuw nsw i64 %119, 1
  %148 = icmp eq i64 %147, %68
  br i1 %148, label %149, label %117

149:
  %150 = phi i64 [ 0, %82 ], [ %146, %117 ]
  %151 = getelementptr inbounds <16 x float>, ptr %85, i64 %150
  %152 = load <16 x float>, ptr %151, align 4
  %153 = fsub contract <16 x float> %84, %152
  %154 = fdiv contract <16 x float> %153, %90
  %155 = fadd contract <16 x float> %154, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %156 = fadd contract <16 x float> %155, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %157 = fmul contract <16 x float> %87, %156
  %158 = fsub contract <16 x float> %153, %157
  %159 = load i64, ptr %43, align 8
  %160 = icmp eq i64 %159, 0
  %161 = fmul contract <16 x float> %92, %158
  br i1 %160, label %162, label %178

162:
  %163 = fmul contract <16 x float> %161, %161
  %164 = shufflevector <16 x float> %163, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %165 = shufflevector <16 x float> %163, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %166 = fadd contract <8 x float> %164, %165
  %167 = shufflevector <8 x float> %166, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %168 = shufflevector <8 x float> %166, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %169 = fadd contract <4 x float> %167, %168
  %170 = shufflevector <4 x float> %169, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %171 = fadd contract <4 x float> %169, %170
  %172 = shufflevector <4 x float> %169, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %173 = fadd contract <4 x float> %169, %172
  %174 = shufflevector <4 x float> %173, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %175 = fadd contract <4 x float> %171, %174
  %176 = extractelement <4 x float> %175, i64 0
  %177 = tail call contract float @llvm.sqrt.f32(float %176)
  br label %181

178:
  %179 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %161)
  %180 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %179)
  br label %181

181:
  %182 = phi float [ %180, %178 ], [ %177, %162 ]
  %183 = load float, ptr %44, align 8
  %184 = fcmp contract ogt float %182, %183
  br i1 %184, label %208, label %213

185:
  %186 = phi i64 [ %192, %185 ], [ %57, %78 ]
  %187 = phi <16 x float> [ %205, %185 ], [ %33, %78 ]
  %188 = phi i64 [ %206, %185 ], [ 0, %78 ]
  %189 = extractelement <16 x float> %36, i64 %188
  %190 = extractelement <16 x float> %33, i64 %188
  %191 = fsub contract float %189, %190
  %192 = add i64 %186, -7046029254386353131
  %193 = lshr i64 %192, 30
  %194 = xor i64 %193, %192
  %195 = mul i64 %194, -4658895280553007687
  %196 = lshr i64 %195, 27
  %197 = xor i64 %196, %195
  %198 = mul i64 %197, -7723592293110705685
  %199 = lshr i64 %198, 40
  %200 = uitofp nneg i64 %199 to float
  %201 = fmul contract float %200, 0x3E70000000000000
  %202 = fmul contract float %191, %201
  %203 = extractelement <16 x float> %187, i64 %188
  %204 = fadd contract float %203, %202
  %205 = insertelement <16 x float> %187, float %204, i64 %188
  %206 = add nuw nsw i64 %188, 1
  %207 = icmp eq i64 %206, %76
  br i1 %207, label %80, label %185

208:
  %209 = fdiv contract float %183, %182
  %210 = insertelement <16 x float> poison, float %209, i64 0
  %211 = shufflevector <16 x float> %210, <16 x float> poison, <16 x i32> zeroinitializer
  %212 = fmul contract <16 x float> %158, %211
  br label %213

213:
  %214 = phi <16 x float> [ %212, %208 ], [ %158, %181 ]
  %215 = fcmp contract oeq float %182, 0.000000e+00
  br i1 %215, label %429, label %216

216:
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %9)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %10)
  store <16 x float> %152, ptr %9, align 64
  store <16 x float> %214, ptr %10, align 64
  %217 = load float, ptr %45, align 4
  %218 = load float, ptr %46, align 8
  %219 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull readonly align 8 dereferenceable(136) %0, ptr noundef nonnull %9, ptr noundef nonnull %10, float noundef %217, float noundef %218)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %9)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %10)
  br i1 %219, label %220, label %429

220:
  %221 = fadd contract <16 x float> %152, %214
  %222 = getelementptr inbounds <16 x float>, ptr %85, i64 %68
  store <16 x float> %221, ptr %222, align 4
  %223 = trunc i64 %150 to i32
  %224 = getelementptr inbounds i8, ptr %63, i64 8
  %225 = load ptr, ptr %224, align 8
  %226 = add nsw i64 %68, 1
  store i64 %226, ptr %67, align 8
  %227 = getelementptr inbounds i32, ptr %225, i64 %68
  store i32 %223, ptr %227, align 4
  %228 = getelementptr <16 x float>, ptr %85, i64 %226
  %229 = getelementptr i8, ptr %228, i64 -64
  %230 = load <16 x float>, ptr %229, align 4
  %231 = load ptr, ptr %66, align 8
  %232 = load ptr, ptr %41, align 8
  %233 = load <16 x float>, ptr %232, align 4
  %234 = fcmp contract oeq <16 x float> %233, zeroinitializer
  %235 = select contract <16 x i1> %234, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %236 = fadd contract <16 x float> %233, %235
  %237 = load ptr, ptr %42, align 8
  %238 = load <16 x float>, ptr %237, align 4
  %239 = icmp sgt i64 %73, 1
  br i1 %239, label %240, label %295

240:
  %241 = load <16 x float>, ptr %231, align 4
  %242 = fsub contract <16 x float> %230, %241
  %243 = fdiv contract <16 x float> %242, %236
  %244 = fadd contract <16 x float> %243, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %245 = fadd contract <16 x float> %244, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %246 = fmul contract <16 x float> %233, %245
  %247 = fsub contract <16 x float> %242, %246
  %248 = fmul contract <16 x float> %238, %247
  %249 = fmul contract <16 x float> %248, %248
  %250 = shufflevector <16 x float> %249, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %251 = shufflevector <16 x float> %249, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %252 = fadd contract <8 x float> %250, %251
  %253 = shufflevector <8 x float> %252, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %254 = shufflevector <8 x float> %252, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %255 = fadd contract <4 x float> %253, %254
  %256 = shufflevector <4 x float> %255, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %257 = fadd contract <4 x float> %255, %256
  %258 = shufflevector <4 x float> %255, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %259 = fadd contract <4 x float> %255, %258
  %260 = shufflevector <4 x float> %259, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %261 = fadd contract <4 x float> %257, %260
  %262 = extractelement <4 x float> %261, i64 0
  br label %263

263:
  %264 = phi i64 [ %292, %263 ], [ 0, %240 ]
  %265 = phi i64 [ %293, %263 ], [ 1, %240 ]
  %266 = phi float [ %291, %263 ], [ %262, %240 ]
  %267 = getelementptr inbounds <16 x float>, ptr %231, i64 %265
  %268 = load <16 x float>, ptr %267, align 4
  %269 = fsub contract <16 x float> %230, %268
  %270 = fdiv contract <16 x float> %269, %236
  %271 = fadd contract <16 x float> %270, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %272 = fadd contract <16 x float> %271, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %273 = fmul contract <16 x float> %233, %272
  %274 = fsub contract <16 x float> %269, %273
  %275 = fmul contract <16 x float> %238, %274
  %276 = fmul contract <16 x float> %275, %275
  %277 = shufflevector <16 x float> %276, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %278 = shufflevector <16 x float> %276, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %279 = fadd contract <8 x float> %277, %278
  %280 = shufflevector <8 x float> %279, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %281 = shufflevector <8 x float> %279, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %282 = fadd contract <4 x float> %280, %281
  %283 = shufflevector <4 x float> %282, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %284 = fadd contract <4 x float> %282, %283
  %285 = shufflevector <4 x float> %282, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %286 = fadd contract <4 x float> %282, %285
  %287 = shufflevector <4 x float> %286, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %288 = fadd contract <4 x float> %284, %287
  %289 = extractelement <4 x float> %288, i64 0
  %290 = fcmp contract olt float %289, %266
  %291 = select i1 %290, float %289, float %266
  %292 = select i1 %290, i64 %265, i64 %264
  %293 = add nuw nsw i64 %265, 1
  %294 = icmp eq i64 %293, %73
  br i1 %294, label %295, label %263

295:
  %296 = phi i64 [ 0, %220 ], [ %292, %263 ]
  %297 = getelementptr inbounds i8, ptr %66, i64 8
  br label %298

298:
  %299 = phi i64 [ %73, %295 ], [ %425, %424 ]
  %300 = phi i64 [ %296, %295 ], [ %426, %424 ]
  %301 = getelementptr inbounds <16 x float>, ptr %231, i64 %300
  %302 = load <16 x float>, ptr %301, align 4
  %303 = fsub contract <16 x float> %230, %302
  %304 = load ptr, ptr %41, align 8
  %305 = load <16 x float>, ptr %304, align 4
  %306 = fcmp contract oeq <16 x float> %305, zeroinitializer
  %307 = select contract <16 x i1> %306, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %308 = fadd contract <16 x float> %305, %307
  %309 = fdiv contract <16 x float> %303, %308
  %310 = fadd contract <16 x float> %309, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %311 = fadd contract <16 x float> %310, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %312 = fmul contract <16 x float> %305, %311
  %313 = fsub contract <16 x float> %303, %312
  %314 = load i64, ptr %43, align 8
  %315 = icmp eq i64 %314, 0
  %316 = load ptr, ptr %42, align 8
  %317 = load <16 x float>, ptr %316, align 4
  %318 = fmul contract <16 x float> %317, %313
  br i1 %315, label %319, label %335

319:
  %320 = fmul contract <16 x float> %318, %318
  %321 = shufflevector <16 x float> %320, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %322 = shufflevector <16 x float> %320, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %323 = fadd contract <8 x float> %321, %322
  %324 = shufflevector <8 x float> %323, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %325 = shufflevector <8 x float> %323, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %326 = fadd contract <4 x float> %324, %325
  %327 = shufflevector <4 x float> %326, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %328 = fadd contract <4 x float> %326, %327
  %329 = shufflevector <4 x float> %326, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %330 = fadd contract <4 x float> %326, %329
  %331 = shufflevector <4 x float> %330, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %332 = fadd contract <4 x float> %328, %331
  %333 = extractelement <4 x float> %332, i64 0
  %334 = tail call contract float @llvm.sqrt.f32(float %333)
  br label %338

335:
  %336 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %318)
  %337 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %336)
  br label %338

338:
  %339 = phi float [ %337, %335 ], [ %334, %319 ]
  %340 = load float, ptr %44, align 8
  %341 = fcmp contract ugt float %339, %340
  br i1 %341, label %342, label %347

342:
  %343 = fdiv contract float %340, %339
  %344 = insertelement <16 x float> poison, float %343, i64 0
  %345 = shufflevector <16 x float> %344, <16 x float> poison, <16 x i32> zeroinitializer
  %346 = fmul contract <16 x float> %313, %345
  br label %347

347:
  %348 = phi <16 x float> [ %313, %338 ], [ %346, %342 ]
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %11)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %12)
  store <16 x float> %302, ptr %11, align 64
  store <16 x float> %348, ptr %12, align 64
  %349 = load float, ptr %45, align 4
  %350 = load float, ptr %46, align 8
  %351 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull readonly align 8 dereferenceable(136) %0, ptr noundef nonnull %11, ptr noundef nonnull %12, float noundef %349, float noundef %350)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %11)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %12)
  br i1 %351, label %352, label %427

352:
  br i1 %341, label %414, label %353

353:
  %354 = select i1 %61, i64 %300, i64 %68
  %355 = select i1 %61, i64 %68, i64 %300
  %356 = icmp slt i64 %354, 0
  br i1 %356, label %375, label %362

357:
  %358 = lshr i64 %369, 1
  %359 = icmp eq i64 %364, 0
  br i1 %359, label %375, label %360

360:
  %361 = getelementptr <16 x float>, ptr %6, i64 %369
  br label %378

362:
  %363 = phi i64 [ %373, %366 ], [ %354, %353 ]
  %364 = phi i64 [ %369, %366 ], [ 0, %353 ]
  %365 = icmp eq i64 %364, 256
  br i1 %365, label %433, label %366

366:
  %367 = getelementptr inbounds <16 x float>, ptr %17, i64 %363
  %368 = load <16 x float>, ptr %367, align 4
  %369 = add nuw nsw i64 %364, 1
  %370 = getelementptr inbounds <16 x float>, ptr %6, i64 %364
  store <16 x float> %368, ptr %370, align 4
  %371 = getelementptr inbounds i32, ptr %20, i64 %363
  %372 = load i32, ptr %371, align 4
  %373 = zext nneg i32 %372 to i64
  %374 = icmp slt i32 %372, 0
  br i1 %374, label %357, label %362

375:
  %376 = phi i64 [ 1, %357 ], [ 0, %353 ], [ %369, %378 ]
  %377 = icmp slt i64 %355, 0
  br i1 %377, label %435, label %387

378:
  %379 = phi i64 [ 0, %360 ], [ %385, %378 ]
  %380 = xor i64 %379, -1
  %381 = getelementptr <16 x float>, ptr %361, i64 %380
  %382 = load <16 x float>, ptr %381, align 4
  %383 = getelementptr inbounds <16 x float>, ptr %6, i64 %379
  %384 = load <16 x float>, ptr %383, align 4
  store <16 x float> %384, ptr %381, align 4
  store <16 x float> %382, ptr %383, align 4
  %385 = add nuw nsw i64 %379, 1
  %386 = icmp eq i64 %385, %358
  br i1 %386, label %375, label %378

387:
  %388 = phi i64 [ %412, %391 ], [ %355, %375 ]
  %389 = phi i64 [ %409, %391 ], [ %376, %375 ]
  store i64 %388, ptr %7, align 8
  %390 = icmp eq i64 %389, 256
  br i1 %390, label %424, label %391

391:
  %392 = getelementptr <16 x float>, ptr %6, i64 %389
  %393 = getelementptr i8, ptr %392, i64 -64
  %394 = load <16 x float>, ptr %393, align 4
  %395 = getelementptr inbounds <16 x float>, ptr %25, i64 %388
  %396 = load <16 x float>, ptr %395, align 4
  %397 = fsub contract <16 x float> %396, %394
  %398 = load ptr, ptr %41, align 8
  %399 = load <16 x float>, ptr %398, align 4
  %400 = fcmp contract oeq <16 x float> %399, zeroinitializer
  %401 = select contract <16 x i1> %400, <16 x float> <float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00, float 1.000000e+00>, <16 x float> zeroinitializer
  %402 = fadd contract <16 x float> %399, %401
  %403 = fdiv contract <16 x float> %397, %402
  %404 = fadd contract <16 x float> %403, <float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000, float 0x4168000000000000>
  %405 = fadd contract <16 x float> %404, <float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000, float 0xC168000000000000>
  %406 = fmul contract <16 x float> %399, %405
  %407 = fsub contract <16 x float> %397, %406
  %408 = fadd contract <16 x float> %394, %407
  store <16 x float> %408, ptr %392, align 4
  %409 = add nuw nsw i64 %389, 1
  %410 = getelementptr inbounds i32, ptr %27, i64 %388
  %411 = load i32, ptr %410, align 4
  %412 = zext nneg i32 %411 to i64
  %413 = icmp slt i32 %411, 0
  br i1 %413, label %435, label %387

414:
  %415 = load i64, ptr %23, align 8
  %416 = icmp slt i64 %299, %415
  br i1 %416, label %417, label %427

417:
  %418 = fadd contract <16 x float> %302, %348
  %419 = getelementptr inbounds <16 x float>, ptr %231, i64 %299
  store <16 x float> %418, ptr %419, align 4
  %420 = trunc i64 %300 to i32
  %421 = load ptr, ptr %297, align 8
  %422 = add nsw i64 %299, 1
  store i64 %422, ptr %72, align 8
  %423 = getelementptr inbounds i32, ptr %421, i64 %299
  store i32 %420, ptr %423, align 4
  br label %424

424:
  %425 = phi i64 [ %422, %417 ], [ %299, %387 ]
  %426 = phi i64 [ %299, %417 ], [ %300, %387 ]
  br i1 %341, label %298, label %433

427:
  %428 = load i64, ptr %37, align 8
  br label %429

429:
  %430 = phi i64 [ %428, %427 ], [ %56, %216 ], [ %56, %213 ]
  %431 = add nuw nsw i64 %58, 1
  %432 = icmp slt i64 %431, %430
  br i1 %432, label %55, label %433

433:
  %434 = phi i64 [ 0, %31 ], [ -1, %362 ], [ -1, %424 ], [ 0, %429 ], [ 0, %71 ], [ 0, %55 ]
  call void @llvm.lifetime.end.p0(i64 48, ptr nonnull %13)
  br label %440

435:
  %436 = phi i64 [ %409, %391 ], [ %376, %375 ]
  store i64 %83, ptr %14, align 8
  call void @llvm.lifetime.end.p0(i64 48, ptr nonnull %13)
  %437 = icmp sgt i64 %436, 2
  br i1 %437, label %438, label %440

438:
  %439 = call fastcc noundef i64 @_ZL13shorten_routeRK5SceneIfERK7ProblemR6RandomPDv16_fx(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull align 8 dereferenceable(96) %1, ptr noundef nonnull align 8 dereferenceable(8) %14, ptr noundef %6, i64 noundef %436)
  br label %440

440:
  %441 = phi i64 [ %439, %438 ], [ %436, %435 ], [ %434, %433 ]
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %14)
  ret i64 %441
}

define internal fastcc noundef i64 @_ZL13shorten_routeRK5SceneIfERK7ProblemR6RandomPDv16_fx(ptr nocapture noundef nonnull readonly align 8 dereferenceable(136) %0, ptr nocapture noundef nonnull readonly align 8 dereferenceable(96) %1, ptr nocapture noundef nonnull align 8 dereferenceable(8) %2, ptr nocapture noundef %3, i64 noundef %4) unnamed_addr {
  %6 = alloca <16 x float>, align 64
  %7 = alloca <16 x float>, align 64
  %8 = alloca <16 x float>, align 64
  %9 = alloca <16 x float>, align 64
  %10 = alloca [256 x float], align 16
  %11 = alloca float, align 4
  %12 = alloca float, align 4
  %13 = alloca i64, align 16
  %14 = alloca i64, align 8
  %15 = alloca <16 x float>, align 64
  %16 = alloca <16 x float>, align 64
  call void @llvm.lifetime.start.p0(i64 1024, ptr nonnull %10)
  %17 = icmp sgt i64 %4, 2
  br i1 %17, label %18, label %268

18:
  %19 = getelementptr inbounds i8, ptr %1, i64 84
  %20 = getelementptr inbounds i8, ptr %1, i64 88
  br label %21

21:
  %22 = phi i64 [ %4, %18 ], [ %66, %65 ]
  %23 = phi i64 [ 0, %18 ], [ %24, %65 ]
  %24 = add nuw nsw i64 %23, 1
  %25 = getelementptr inbounds <16 x float>, ptr %3, i64 %23
  %26 = load float, ptr %19, align 4
  %27 = load float, ptr %20, align 8
  br label %39

28:
  %29 = getelementptr inbounds i8, ptr %1, i64 56
  %30 = icmp sgt i64 %66, 2
  %31 = load i64, ptr %29, align 8
  %32 = icmp sgt i64 %31, 0
  %33 = select i1 %30, i1 %32, i1 false
  br i1 %33, label %34, label %268

34:
  %35 = getelementptr inbounds i8, ptr %1, i64 32
  %36 = getelementptr inbounds i8, ptr %1, i64 16
  %37 = getelementptr inbounds i8, ptr %1, i64 84
  %38 = getelementptr inbounds i8, ptr %1, i64 88
  br label %69

39:
  %40 = phi i64 [ %41, %43 ], [ %22, %21 ]
  %41 = add nsw i64 %40, -1
  %42 = icmp sgt i64 %41, %24
  br i1 %42, label %43, label %65

43:
  %44 = load <16 x float>, ptr %25, align 4
  %45 = getelementptr inbounds <16 x float>, ptr %3, i64 %41
  %46 = load <16 x float>, ptr %45, align 4
  %47 = fsub contract <16 x float> %46, %44
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %6)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %7)
  store <16 x float> %44, ptr %6, align 64
  store <16 x float> %47, ptr %7, align 64
  %48 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull %6, ptr noundef nonnull %7, float noundef %26, float noundef %27)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %6)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %7)
  br i1 %48, label %49, label %39

49:
  %50 = sub i64 1, %40
  %51 = icmp sgt i64 %40, %22
  br i1 %51, label %55, label %52

52:
  %53 = getelementptr <16 x float>, ptr %3, i64 %50
  %54 = getelementptr <16 x float>, ptr %53, i64 %24
  br label %58

55:
  %56 = add i64 %22, %24
  %57 = add i64 %56, %50
  br label %65

58:
  %59 = phi i64 [ %41, %52 ], [ %63, %58 ]
  %60 = getelementptr inbounds <16 x float>, ptr %3, i64 %59
  %61 = load <16 x float>, ptr %60, align 4
  %62 = getelementptr <16 x float>, ptr %54, i64 %59
  store <16 x float> %61, ptr %62, align 4
  %63 = add nsw i64 %59, 1
  %64 = icmp eq i64 %63, %22
  br i1 %64, label %55, label %58

65:
  %66 = phi i64 [ %57, %55 ], [ %22, %39 ]
  %67 = add nuw nsw i64 %23, 3
  %68 = icmp slt i64 %67, %66
  br i1 %68, label %21, label %28

69:
  %70 = phi i64 [ %66, %34 ], [ %263, %261 ]
  %71 = phi i64 [ 0, %34 ], [ %262, %261 ]
  store float 0.000000e+00, ptr %10, align 16
  %72 = load i64, ptr %35, align 8
  %73 = icmp eq i64 %72, 0
  %74 = load ptr, ptr %36, align 8
  %75 = load <16 x float>, ptr %3, align 4
  %76 = load <16 x float>, ptr %74, align 4
  br label %105

77:
  %78 = add nsw i64 %70, -1
  %79 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %78
  %80 = load float, ptr %79, align 4
  call void @llvm.lifetime.start.p0(i64 4, ptr nonnull %11)
  call void @llvm.lifetime.start.p0(i64 4, ptr nonnull %12)
  %81 = load i64, ptr %2, align 8
  %82 = add i64 %81, -7046029254386353131
  %83 = lshr i64 %82, 30
  %84 = xor i64 %83, %82
  %85 = mul i64 %84, -4658895280553007687
  %86 = lshr i64 %85, 27
  %87 = xor i64 %86, %85
  %88 = mul i64 %87, -7723592293110705685
  %89 = lshr i64 %88, 40
  %90 = uitofp nneg i64 %89 to float
  %91 = fmul contract float %90, 0x3E70000000000000
  %92 = fmul contract float %80, %91
  store float %92, ptr %11, align 4
  %93 = add i64 %81, 4354685564936845354
  store i64 %93, ptr %2, align 8
  %94 = lshr i64 %93, 30
  %95 = xor i64 %94, %93
  %96 = mul i64 %95, -4658895280553007687
  %97 = lshr i64 %96, 27
  %98 = xor i64 %97, %96
  %99 = mul i64 %98, -7723592293110705685
  %100 = lshr i64 %99, 40
  %101 = uitofp nneg i64 %100 to float
  %102 = fmul contract float %101, 0x3E70000000000000
  %103 = fmul contract float %80, %102
  store float %103, ptr %12, align 4
  %104 = fcmp contract ogt float %92, %103
  br i1 %104, label %138, label %139

105:
  %106 = phi <16 x float> [ %75, %69 ], [ %110, %132 ]
  %107 = phi float [ 0.000000e+00, %69 ], [ %134, %132 ]
  %108 = phi i64 [ 1, %69 ], [ %136, %132 ]
  %109 = getelementptr inbounds <16 x float>, ptr %3, i64 %108
  %110 = load <16 x float>, ptr %109, align 4
  %111 = fsub contract <16 x float> %110, %106
  %112 = fmul contract <16 x float> %111, %76
  br i1 %73, label %113, label %129

113:
  %114 = fmul contract <16 x float> %112, %112
  %115 = shufflevector <16 x float> %114, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %116 = shufflevector <16 x float> %114, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %117 = fadd contract <8 x float> %115, %116
  %118 = shufflevector <8 x float> %117, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %119 = shufflevector <8 x float> %117, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %120 = fadd contract <4 x float> %118, %119
  %121 = shufflevector <4 x float> %120, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %122 = fadd contract <4 x float> %120, %121
  %123 = shufflevector <4 x float> %120, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %124 = fadd contract <4 x float> %120, %123
  %125 = shufflevector <4 x float> %124, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %126 = fadd contract <4 x float> %122, %125
  %127 = extractelement <4 x float> %126, i64 0
  %128 = tail call contract float @llvm.sqrt.f32(float %127)
  br label %132

129:
  %130 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %112)
  %131 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %130)
  br label %132

132:
  %133 = phi float [ %131, %129 ], [ %128, %113 ]
  %134 = fadd contract float %107, %133
  %135 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %108
  store float %134, ptr %135, align 4
  %136 = add nuw nsw i64 %108, 1
  %137 = icmp eq i64 %136, %70
  br i1 %137, label %77, label %105

138:
  store float %103, ptr %11, align 4
  store float %92, ptr %12, align 4
  br label %139

139:
  %140 = phi float [ %103, %138 ], [ %92, %77 ]
  %141 = phi float [ %92, %138 ], [ %103, %77 ]
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %13)
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %14)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %15)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %16)
  %142 = add nsw i64 %70, -2
  %143 = add nsw i64 %70, -1
  %144 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %143
  br label %145

145:
  %146 = phi i1 [ true, %139 ], [ false, %213 ]
  %147 = phi ptr [ %15, %139 ], [ %16, %213 ]
  %148 = phi ptr [ %13, %139 ], [ %14, %213 ]
  %149 = phi ptr [ %11, %139 ], [ %12, %213 ]
  br label %190

150:
  %151 = fsub contract float %141, %140
  %152 = load <16 x float>, ptr %16, align 64
  %153 = load <16 x float>, ptr %15, align 64
  %154 = fsub contract <16 x float> %152, %153
  %155 = load i64, ptr %35, align 8
  %156 = icmp eq i64 %155, 0
  %157 = load ptr, ptr %36, align 8
  %158 = load <16 x float>, ptr %157, align 4
  %159 = fmul contract <16 x float> %154, %158
  br i1 %156, label %160, label %176

160:
  %161 = fmul contract <16 x float> %159, %159
  %162 = shufflevector <16 x float> %161, <16 x float> poison, <8 x i32> <i32 0, i32 1, i32 2, i32 3, i32 4, i32 5, i32 6, i32 7>
  %163 = shufflevector <16 x float> %161, <16 x float> poison, <8 x i32> <i32 8, i32 9, i32 10, i32 11, i32 12, i32 13, i32 14, i32 15>
  %164 = fadd contract <8 x float> %162, %163
  %165 = shufflevector <8 x float> %164, <8 x float> poison, <4 x i32> <i32 0, i32 1, i32 2, i32 3>
  %166 = shufflevector <8 x float> %164, <8 x float> poison, <4 x i32> <i32 4, i32 5, i32 6, i32 7>
  %167 = fadd contract <4 x float> %165, %166
  %168 = shufflevector <4 x float> %167, <4 x float> poison, <4 x i32> <i32 2, i32 poison, i32 poison, i32 poison>
  %169 = fadd contract <4 x float> %167, %168
  %170 = shufflevector <4 x float> %167, <4 x float> poison, <4 x i32> <i32 poison, i32 3, i32 poison, i32 poison>
  %171 = fadd contract <4 x float> %167, %170
  %172 = shufflevector <4 x float> %171, <4 x float> poison, <4 x i32> <i32 1, i32 poison, i32 poison, i32 poison>
  %173 = fadd contract <4 x float> %169, %172
  %174 = extractelement <4 x float> %173, i64 0
  %175 = tail call contract float @llvm.sqrt.f32(float %174)
  br label %179

176:
  %177 = tail call contract <16 x float> @llvm.fabs.v16f32(<16 x float> %159)
  %178 = tail call contract float @llvm.vector.reduce.fmax.v16f32(<16 x float> %177)
  br label %179

179:
  %180 = phi float [ %178, %176 ], [ %175, %160 ]
  %181 = fsub contract float %151, %180
  %182 = load i64, ptr %13, align 16
  %183 = load i64, ptr %14, align 8
  %184 = icmp eq i64 %182, %183
  %185 = fmul contract float %80, 0x3F1A36E2E0000000
  %186 = fcmp contract olt float %181, %185
  %187 = select i1 %184, i1 true, i1 %186
  %188 = icmp sgt i64 %70, 254
  %189 = or i1 %188, %187
  br i1 %189, label %228, label %224

190:
  %191 = phi i64 [ %196, %195 ], [ 0, %145 ]
  %192 = icmp eq i64 %191, %142
  br i1 %192, label %193, label %195

193:
  %194 = load float, ptr %144, align 4
  br label %201

195:
  %196 = add nuw nsw i64 %191, 1
  %197 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %196
  %198 = load float, ptr %197, align 4
  %199 = load float, ptr %149, align 4
  %200 = fcmp contract olt float %198, %199
  br i1 %200, label %190, label %201

201:
  %202 = phi float [ %194, %193 ], [ %198, %195 ]
  %203 = phi i64 [ %143, %193 ], [ %196, %195 ]
  %204 = phi i64 [ %142, %193 ], [ %191, %195 ]
  %205 = getelementptr inbounds [256 x float], ptr %10, i64 0, i64 %204
  %206 = load float, ptr %205, align 4
  %207 = fsub contract float %202, %206
  %208 = fcmp contract ogt float %207, 0.000000e+00
  br i1 %208, label %209, label %213

209:
  %210 = load float, ptr %149, align 4
  %211 = fsub contract float %210, %206
  %212 = fdiv contract float %211, %207
  br label %213

213:
  %214 = phi contract float [ %212, %209 ], [ 0.000000e+00, %201 ]
  %215 = getelementptr inbounds <16 x float>, ptr %3, i64 %204
  %216 = load <16 x float>, ptr %215, align 4
  %217 = insertelement <16 x float> poison, float %214, i64 0
  %218 = shufflevector <16 x float> %217, <16 x float> poison, <16 x i32> zeroinitializer
  %219 = getelementptr inbounds <16 x float>, ptr %3, i64 %203
  %220 = load <16 x float>, ptr %219, align 4
  %221 = fsub contract <16 x float> %220, %216
  %222 = fmul contract <16 x float> %218, %221
  %223 = fadd contract <16 x float> %216, %222
  store <16 x float> %223, ptr %147, align 64
  store i64 %204, ptr %148, align 8
  br i1 %146, label %145, label %150

224:
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %8)
  call void @llvm.lifetime.start.p0(i64 64, ptr nonnull %9)
  store <16 x float> %153, ptr %8, align 64
  store <16 x float> %154, ptr %9, align 64
  %225 = load float, ptr %37, align 4
  %226 = load float, ptr %38, align 8
  %227 = call fastcc noundef zeroext i1 @_ZL12is_edge_freeRK5SceneIfEPKfS4_ff(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull %8, ptr noundef nonnull %9, float noundef %225, float noundef %226)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %8)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %9)
  br i1 %227, label %230, label %228

228:
  %229 = add nsw i64 %71, 1
  br label %261

230:
  %231 = fmul contract float %80, 0x3F847AE140000000
  %232 = fcmp contract ogt float %181, %231
  %233 = select i1 %232, i64 0, i64 %71
  %234 = sub i64 %182, %183
  %235 = add i64 %234, 2
  %236 = icmp sgt i64 %235, 0
  br i1 %236, label %240, label %237

237:
  %238 = add nsw i64 %183, 1
  %239 = icmp slt i64 %238, %70
  br i1 %239, label %249, label %256

240:
  %241 = icmp sgt i64 %78, %183
  br i1 %241, label %242, label %256

242:
  %243 = phi i64 [ %247, %242 ], [ %78, %240 ]
  %244 = getelementptr inbounds <16 x float>, ptr %3, i64 %243
  %245 = load <16 x float>, ptr %244, align 4
  %246 = getelementptr <16 x float>, ptr %244, i64 %235
  store <16 x float> %245, ptr %246, align 4
  %247 = add nsw i64 %243, -1
  %248 = icmp sgt i64 %247, %183
  br i1 %248, label %242, label %256

249:
  %250 = phi i64 [ %254, %249 ], [ %238, %237 ]
  %251 = getelementptr inbounds <16 x float>, ptr %3, i64 %250
  %252 = load <16 x float>, ptr %251, align 4
  %253 = getelementptr <16 x float>, ptr %251, i64 %235
  store <16 x float> %252, ptr %253, align 4
  %254 = add nsw i64 %250, 1
  %255 = icmp eq i64 %254, %70
  br i1 %255, label %256, label %249

256:
  %257 = getelementptr <16 x float>, ptr %3, i64 %182
  %258 = getelementptr i8, ptr %257, i64 64
  store <16 x float> %153, ptr %258, align 4
  %259 = getelementptr i8, ptr %257, i64 128
  store <16 x float> %152, ptr %259, align 4
  %260 = add nsw i64 %235, %70
  br label %261

261:
  %262 = phi i64 [ %229, %228 ], [ %233, %256 ]
  %263 = phi i64 [ %70, %228 ], [ %260, %256 ]
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %15)
  call void @llvm.lifetime.end.p0(i64 64, ptr nonnull %16)
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %13)
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %14)
  call void @llvm.lifetime.end.p0(i64 4, ptr nonnull %11)
  call void @llvm.lifetime.end.p0(i64 4, ptr nonnull %12)
  %264 = icmp sgt i64 %263, 2
  %265 = load i64, ptr %29, align 8
  %266 = icmp slt i64 %262, %265
  %267 = select i1 %264, i1 %266, i1 false
  br i1 %267, label %69, label %268

268:
  %269 = phi i64 [ %66, %28 ], [ %4, %5 ], [ %263, %261 ]
  call void @llvm.lifetime.end.p0(i64 1024, ptr nonnull %10)
  ret i64 %269
}

define noundef i64 @shorten(ptr nocapture noundef nonnull readonly %0, ptr nocapture noundef nonnull readonly %1, ptr nocapture noundef %2, i64 noundef %3, i64 noundef %4) {
  %6 = alloca %struct.Random, align 8
  call void @llvm.lifetime.start.p0(i64 8, ptr nonnull %6)
  store i64 %4, ptr %6, align 8
  %7 = call fastcc noundef i64 @_ZL13shorten_routeRK5SceneIfERK7ProblemR6RandomPDv16_fx(ptr noundef nonnull align 8 dereferenceable(136) %0, ptr noundef nonnull align 8 dereferenceable(96) %1, ptr noundef nonnull align 8 dereferenceable(8) %6, ptr noundef %2, i64 noundef %3)
  call void @llvm.lifetime.end.p0(i64 8, ptr nonnull %6)
  ret i64 %7
}

declare void @llvm.memset.p0.i64(ptr nocapture writeonly, i8, i64, i1 immarg)

declare <16 x float> @llvm.fabs.v16f32(<16 x float>)

declare void @llvm.memcpy.p0.p0.i64(ptr noalias nocapture writeonly, ptr noalias nocapture readonly, i64, i1 immarg)

declare <16 x float> @llvm.sqrt.v16f32(<16 x float>)

declare <8 x double> @llvm.fabs.v8f64(<8 x double>)

declare <8 x double> @llvm.sqrt.v8f64(<8 x double>)

declare float @llvm.sqrt.f32(float)

declare float @llvm.vector.reduce.fmax.v16f32(<16 x float>)

declare i64 @llvm.smin.i64(i64, i64)



